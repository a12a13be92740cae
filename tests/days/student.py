"""Somebody who follows a day word by word: a home, terminals, an editor, and the day's commands.

What is typed is read from the lesson itself, so a changed text is what is typed.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path

from terminals import Terminal, opened

from lesson_runs import lessons
from roslings_learn.lessons.rules import Lesson

BLOCK = re.compile(r"^```bash\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PLACED = re.compile(r"Terminal (\d), in [^:\n]+:(?:\n\n|$)" + BLOCK.pattern[1:], re.M | re.DOTALL)
GOES_ON = re.compile(r" *\\\n *")


@dataclass(frozen=True)
class Commands:
    """A block that is typed, line by line."""

    terminal: int
    lines: tuple[str, ...]


def lesson_of(day: int) -> Lesson:
    """The lesson as it is committed."""
    (found,) = (lesson for lesson in lessons() if lesson.day.number == day)
    return found


def text_of(lesson: Lesson, sections: Sequence[str]) -> str:
    """The prose of these sections, in their order."""
    cells = [cell for title in sections for cell in lesson.sections[title] if not cell.is_code]
    return "\n".join(cell.text + "\n" for cell in cells)


def placed(text: str) -> list[Commands]:
    """Each block of commands that names its terminal, in the text's order.

    A line that ends in a backslash goes on in the next one.
    """
    found = PLACED.findall(text)
    return [
        Commands(int(number), tuple(GOES_ON.sub(" ", typed).splitlines()))
        for number, typed in found
    ]


@dataclass
class Student:
    """Who types a day's commands, one block after the other."""

    home: Path
    domain: int
    stack: ExitStack
    text: str
    """What is followed."""
    left: list[Commands] = field(init=False)
    done: list[Commands] = field(default_factory=list)
    terminals: dict[int, Terminal] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.left = placed(self.text)

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
        block = self.done[number]
        terminal, said = self.terminal(block.terminal), ""
        for line in block.lines[:-1]:
            terminal.type(line)
            terminal.is_free()
            said += terminal.heard()
        terminal.type(block.lines[-1])
        return terminal, said

    def types_of_the_text(self, number: int, command: str) -> Terminal:
        """A command that stands in a sentence, in backticks."""
        assert f"`{command}`" in " ".join(self.text.split()), f"the text has no `{command}`"
        terminal = self.terminal(number)
        terminal.type(command)
        return terminal

    def promised(self, words: str) -> str:
        """A pattern of words that the text says will come: who rewords it rewords this."""
        assert words in " ".join(self.text.split()), f"the text does not say {words!r}"
        return re.escape(words)

    def ends(self, number: int) -> str:
        """Ctrl-C in a terminal; what it showed."""
        self.terminals[number].press_ctrl_c()
        self.terminals[number].is_free()
        return self.terminals[number].heard()

    def closes(self, number: int) -> None:
        """Close a terminal, so that the next use of this number opens a new one."""
        del self.terminals[number]


def save_as(package: Path, own: Path) -> None:
    """Saved now: setuptools takes no file that is older than the one of its last build."""
    shutil.copytree(package, own, dirs_exist_ok=True, copy_function=shutil.copy)
