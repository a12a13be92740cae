"""Day 2's lab as its lesson tells it: every command typed, in the terminal that is named.

What the student writes between them is taken from the solution, TODO by TODO.
"""

from __future__ import annotations

import re
import shutil
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from lesson_runs import lessons
from terminals import Terminal, opened

from roslings.arena.lease import leased_domain
from roslings.course import lab, root

sys.path.append(str(root() / "tests" / "labs"))
from half_done import states

LAB = lab("nodes")
SECTIONS = ("The lab", "The check")
BLOCK = re.compile(r"Terminal (\d), in [^:\n]+:\n\n```bash\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks() -> list[tuple[int, list[str]]]:
    """Each block of commands of the lab, and the number of its terminal."""
    (day,) = (lesson for lesson in lessons() if lesson.day.number == 2)
    cells = [cell for title in SECTIONS for cell in day.sections[title] if not cell.is_code]
    text = "\n".join(cell.text + "\n" for cell in cells)
    return [(int(number), typed.splitlines()) for number, typed in BLOCK.findall(text)]


@dataclass
class Student:
    """Somebody who has read until the lab: a home, some terminals, an editor."""

    home: Path
    domain: int
    stack: ExitStack
    left: list[tuple[int, list[str]]] = field(default_factory=blocks)
    done: list[tuple[int, list[str]]] = field(default_factory=list)
    terminals: dict[int, Terminal] = field(default_factory=dict)

    def terminal(self, number: int) -> Terminal:
        """It is opened when it is first needed."""
        if number not in self.terminals:
            self.terminals[number] = self.stack.enter_context(opened(self.home, self.domain))
            self.terminals[number].is_free()
        return self.terminals[number]

    def types(self) -> tuple[Terminal, str]:
        """The next block; its last command may go on. What the ones before have said, too."""
        self.done.append(self.left.pop(0))
        return self.types_again(-1)

    def types_again(self, number: int) -> tuple[Terminal, str]:
        """A block of before, as the text says now and then."""
        at, lines = self.done[number]
        terminal, said = self.terminal(at), ""
        for line in lines[:-1]:
            terminal.type(line)
            terminal.is_free()
            said += terminal.heard()
        terminal.type(lines[-1])
        return terminal, said

    def writes(self, todo: int) -> None:
        """The TODOs up to this one, as the solution does them."""
        (state,) = (each for each in states(LAB) if each.done == todo)
        self._has(state.make(self.home / "typed" / str(todo) / LAB.card.package))

    def writes_all(self) -> None:
        """Every TODO: the solution."""
        self._has(LAB.solution)

    def _has(self, package: Path) -> None:
        """Saved now: setuptools takes no file that is older than the one of its last build."""
        own = self.home / "roslings_ws" / "src" / LAB.card.package
        shutil.copytree(package, own, dirs_exist_ok=True, copy_function=shutil.copy)

    def ends(self, number: int) -> str:
        """Ctrl-C in a terminal; what it showed."""
        self.terminals[number].press_ctrl_c()
        self.terminals[number].is_free()
        return self.terminals[number].heard()


@pytest.fixture
def student(tmp_path: Path) -> Iterator[Student]:
    """With an empty home, in the course's folder."""
    with leased_domain() as domain, ExitStack() as stack:
        yield Student(tmp_path, domain, stack)


@pytest.mark.slow
def test_the_lab_of_day_2_goes_as_its_lesson_tells(student: Student) -> None:
    """No command that fails, and each success looks as it is described."""
    _, started = student.types()
    assert re.search(r"roslings_ws/src/rover_status \(6 files\)", started)
    student.terminal(1).is_free()
    student.writes(10)
    student.types()[0].shows("1 package finished")  # step 3
    student.types()[0].shows("Publishing: ")  # step 4
    echo, listed = student.types()
    assert "/minimal_publisher" in listed.split()
    echo.shows(r"(?s)data: \D+\d+.*data: \D+\d+")
    student.ends(3)
    student.types()[0].shows(r"average rate: (0\.9|1\.0)")
    student.ends(2)
    student.writes(11)
    student.terminal(1).is_free()
    student.types_again(1)[0].shows("1 package finished")  # step 5
    student.types()[0].shows("Publishing: ")
    student.terminals[3].shows(r"average rate: (1\.9|2\.0)")
    student.ends(2)
    student.types()[0].shows("Publishing: ")  # step 6
    student.terminal(1).is_free()
    student.types()[0].shows("Publishing: ")
    student.ends(3)
    picture, _ = student.types()
    for name in ("/left/first", "/right/second", "/left/robot_status", "/right/robot_status"):
        picture.shows(name)
    picture.is_free()
    assert "KeyboardInterrupt" in student.ends(1) and "KeyboardInterrupt" in student.ends(2)
    student.writes_all()
    del student.terminals[1]  # step 7: a new one
    _, built = student.types()
    assert "1 package finished" in built
    student.terminal(1).is_free()
    student.types_again(2)[0].shows("Publishing: ")
    assert "Traceback" not in student.ends(2)
    student.types()[0].shows("100 of 100")
    assert student.left == []
