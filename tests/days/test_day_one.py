"""Day 1's lab as its lesson tells it: every command typed, in the terminal that is named."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import ExitStack, closing
from pathlib import Path

import pytest
from student import BLOCK, Student, lesson_of, placed, text_of
from terminals import Terminal, until

from ros2_on_pip.domain_lease import lease, leased_domain

LESSON = lesson_of(1)
SECTIONS = ("The lab", "The check")
HEARD = r"I heard: \[Hello World: \d+\]"


@pytest.fixture
def student(tmp_path: Path) -> Iterator[Student]:
    """With an empty home, in the course's folder; nobody else is in the domain of the text."""
    with leased_domain() as domain, ExitStack() as stack:
        one = Student(tmp_path, domain, stack, text_of(LESSON, SECTIONS))
        stack.enter_context(closing(_held(domain_named(one.text))))
        yield one


def domain_named(text: str) -> int:
    """The one that both terminals get."""
    first, second = re.findall(r"^export ROS_DOMAIN_ID=(\d+)$", text, re.M)
    assert first == second
    return int(first)


def _held(domain: int) -> ExitStack:
    """The lease of a domain, as soon as nobody else on this machine has it."""
    stack, got = ExitStack(), list[bool]()

    def have() -> bool:
        if found := lease(domain):
            got.append(True)
            stack.enter_context(found)
        return bool(got)

    until(have, lambda: f"somebody keeps domain {domain}")
    return stack


def types_shown(terminal: Terminal, command: str) -> str:
    """A command that a screen has shown, to its end; what it said."""
    terminal.type(command)
    terminal.is_free()
    return terminal.heard()


def says_three_more(talker: Terminal) -> None:
    """A listener that could hear it would have had the time."""
    before = talker.heard().count("Publishing: ")
    until(lambda: talker.heard().count("Publishing: ") > before + 2, lambda: f"silent:\n{talker}")


def test_each_step_of_the_lab_names_its_terminal() -> None:
    """So that each command of it is typed below."""
    text = text_of(LESSON, SECTIONS)
    assert len(placed(text)) == len(BLOCK.findall(text)) > 0


@pytest.mark.slow
def test_the_lab_of_day_1_goes_as_its_lesson_tells(student: Student) -> None:
    """No command that fails, and each success looks as it is described."""
    student.types()[0].shows(r"labs\s+can\s+start|Nothing to mend")  # step 2
    student.terminal(1).is_free()
    student.types()[0].shows(r"Publishing: .Hello World: \d+")  # step 3
    student.promised("says `I heard: [Hello World: 1]`, with growing numbers")
    student.types()[0].shows(HEARD)
    picture, _ = student.types()
    for name in ("/talker", "/listener", "/chatter"):
        picture.shows(student.promised(f"`{name}`").replace("`", ""))
    student.ends(2)
    deaf, _ = student.types()  # step 4
    student.promised("It hears nothing.")
    says_three_more(student.terminals[1])
    assert not re.search(HEARD, deaf.heard())
    student.ends(1)
    student.types()
    deaf.shows(HEARD)
    for number in (1, 2):
        student.ends(number)
        student.closes(number)
    break_and_mend(student)
    doctor, _ = student.types()  # the check
    doctor.tells(student.promised("100 of 100"))
    assert student.left == []


def break_and_mend(student: Student) -> None:
    """Step 5: the steps that the screen shows, typed in a new terminal."""
    shown, _ = student.types()
    shown.is_free()
    injure, talk, ask, check = re.findall(r"^ {7}(\S.*?)\r?$", shown.heard(), re.M)
    ill = student.terminal(2)
    types_shown(ill, "source setup.bash")
    types_shown(ill, injure)
    assert "ROS_DOMAIN_ID" in types_shown(ill, talk)
    assert "FAULT" in types_shown(ill, ask)
    types_shown(ill, "unset ROS_DOMAIN_ID")
    student.promised(
        "`./roslings break 8 --check`, in that terminal, says that the exercise is mended"
    )
    assert "mended" in types_shown(ill, check)
