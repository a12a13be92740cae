"""What is to be printed, put together before anything is printed, so that it can be measured."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator

from rich import box
from rich.cells import cell_len
from rich.console import Console, Group, RenderableType
from rich.padding import Padding
from rich.panel import Panel
from rich.text import Text

from ros2_on_pip.language import Text as Words
from ros2_on_pip.safe_text import can_show, cut_to, filled, harmless, in_encoding, wrapped
from roslings.report.command_line import CommandLine
from roslings.report.lesson_link import link_of

MARKS = {"pass": "✓", "fail": "✗", "skip": "○", "inconclusive": "?"}
ASCII_MARKS = {"pass": "+", "fail": "x", "skip": "-", "inconclusive": "?"}
LABEL_WIDTH = 10
LONGEST_TEXT_LINES = 12
LONGEST_LOG_LINES = 3  # for each line of the log
NARROWEST = 24
Part = RenderableType | Callable[[], Iterable[RenderableType]]
"""What is shown, or what makes it when all labels are known."""


class Page:
    """Lines for one console: as wide as it is, in characters that its encoding has."""

    def __init__(self, console: Console, command_line: CommandLine) -> None:
        """`command_line`: how the verdict was asked for; what is typed next is said like that."""
        self._console = console
        self.command_line = command_line
        self._parts: list[Part] = []
        self._column = LABEL_WIDTH
        """Columns of the widest label so far, with the blank behind it: all texts begin there."""
        self.width = max(console.width, NARROWEST)
        self.marks = MARKS if self._shows("".join(MARKS.values()) + "…╭") else ASCII_MARKS

    def _shows(self, text: str) -> bool:
        # The Linux text console says UTF-8, but its fonts hold few marks.
        return can_show(text, self._console.encoding) and os.environ.get("TERM") != "linux"

    @property
    def _ellipsis(self) -> str:
        return "…" if self.marks is MARKS else "..."

    def plain(self, text: str | Words, *, keep_newlines: bool = False) -> str:
        """`text` without control characters and in this console's encoding."""
        safe = harmless(str(text), keep_newlines=keep_newlines)
        return in_encoding(safe, self._console.encoding)

    def blank(self) -> None:
        """An empty line."""
        self._parts.append(Text(""))

    def line(self, text: str | Words, style: str = "") -> None:
        """One line; its end is cut off, visibly, where it is too long."""
        cut = cut_to(self.plain(text), self.width, cell_len, self._ellipsis)
        self._parts.append(Text(cut, style))

    def headed(self, head: str, text: str, *, style: str, text_style: str = "") -> None:
        """`head`, styled, and `text` beside it in as many lines as it needs."""
        lines = wrapped(self.plain(text), self.width - cell_len(head), cell_len)
        self._beside(head, lines, style, text_style)

    def headed_line(self, head: str, text: str, *, style: str) -> None:
        """`head`, styled, and `text` beside it on the same line, cut off where it is too long."""
        room = self.width - cell_len(head)
        self._beside(head, [cut_to(self.plain(text), room, cell_len, self._ellipsis)], style)

    def headed_items(self, head: str, items: Iterable[str], *, style: str) -> None:
        """`head`, styled, and `items` one after the other, none broken in two."""
        room = self.width - cell_len(head)
        self._beside(head, filled(map(self.plain, items), room, cell_len, ", "), style)

    def text(self, text: str, *, indent: int = 0) -> None:
        """A text of some lines, with its own line breaks."""
        room = self.width - indent
        lines = wrapped(self.plain(text, keep_newlines=True), room, cell_len)
        self._beside(" " * indent, lines, "")

    def labelled(
        self, label: str | Words, text: str | Words, *, indent: int = 0, style: str = ""
    ) -> None:
        """A short label, and a text of some lines beside it."""

        def lines(room: int) -> list[str]:
            return self._bounded(str(text), room, LONGEST_TEXT_LINES, keep_newlines=True)

        self._behind_label(" " * indent, self.plain(label), lines, style)

    def _behind_label(
        self, indent: str, label: str, lines: Callable[[int], list[str]], style: str = ""
    ) -> None:
        """Filled when the page is whole: a label may be long in its language, and moves all."""
        self._column = max(self._column, cell_len(label) + 1)

        def part() -> Iterator[RenderableType]:
            head = indent + label + " " * (self._column - cell_len(label))
            yield from self._lines(head, lines(self.width - cell_len(head)), "bold", style)

        self._parts.append(part)

    def lesson(self, label: str | Words, lesson: str, *, indent: int = 0) -> None:
        """Where a lesson tells of it; a terminal that can opens it at a click."""
        link = link_of(lesson)
        self.labelled(label, lesson, indent=indent, style=f"link {link}" if link else "")

    def command(self, label: str | Words, text: str | Words, command: str) -> None:
        """A label, a sentence, and what to type, which no line break comes into."""
        words = [*self.plain(text).split(), self.plain(command)]
        self._behind_label("", self.plain(label), lambda room: filled(words, room, cell_len))

    def _beside(self, head: str, lines: list[str], style: str, text_style: str = "") -> None:
        self._parts += self._lines(head, lines, style, text_style)

    @staticmethod
    def _lines(head: str, lines: list[str], style: str, text_style: str) -> Iterator[Text]:
        margin = " " * cell_len(head)
        for number, line in enumerate(lines):
            start = (margin, "") if number else (head, style)
            yield Text.assemble(start, (line, text_style))

    def boxed(self, title: str, lines: Iterable[str], *, indent: int = 0) -> None:
        """Lines that are somebody else's, e.g. a node's log, in a box of their own.

        A terminal that only has lines, as a screen reader's, gets no box: it would be read out.
        """
        room = self.width - indent - 4
        shown = [part for line in lines for part in self._bounded(line, room, LONGEST_LOG_LINES)]
        if self._console.is_dumb_terminal:
            self.text(f"{title}:", indent=indent)
            self._beside(" " * (indent + 2), shown, "")
            return
        panel = Panel(
            Text("\n".join(shown), no_wrap=True, overflow="ignore"),
            title=Text(cut_to(self.plain(title), room - 2, cell_len, self._ellipsis)),
            title_align="left",
            box=box.ROUNDED if self.marks is MARKS else box.ASCII,
            border_style="dim",
            width=self.width - indent,
        )
        self._parts.append(Padding(panel, (0, 0, 0, indent), expand=False))

    def _bounded(
        self, text: str, room: int, at_most: int, *, keep_newlines: bool = False
    ) -> list[str]:
        """`text` in at most `at_most` lines; where more are missing the last one says so."""
        enough = text[: room * (at_most + 1)]  # cut before wrapping: it may be a megabyte long
        lines = wrapped(self.plain(enough, keep_newlines=keep_newlines), room, cell_len)
        if len(lines) <= at_most and enough == text:
            return lines
        *kept, last = lines[:at_most]
        return [*kept, cut_to(last, room - len(self._ellipsis), cell_len, "") + self._ellipsis]

    def height(self) -> int:
        """Lines that the page takes on its console."""
        return len(self._console.render_lines(self._whole(), pad=False))

    def _whole(self) -> Group:
        made = ([part] if not callable(part) else part() for part in self._parts)
        return Group(*(each for parts in made for each in parts))

    def print(self) -> None:
        """Show it."""
        self._console.print(self._whole(), highlight=False, markup=False, emoji=False, crop=False)
