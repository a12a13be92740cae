"""Lines with a label before them, in a column as wide as its widest label is on the screen.

A label is longer in another language, and some letters take two columns. What does not fit goes on
in the next line, beside the label and never under it. Standard library only: the first screen is
made of this.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from unicodedata import combining, east_asian_width

from ros2_on_pip import safe_text

SCREEN = 80
"""Columns that every terminal has."""
FEWEST = 20
"""So many are left for a text, however long the label is."""
GAP = "    "
"""Between what is typed and what it is for."""


@dataclass(frozen=True)
class LabelledLine:
    """One label and what stands behind it."""

    label: str
    text: str = ""
    """For people: it may be wrapped."""
    typed: str = ""
    """A command or a path, which stands first and in one piece."""


def columns_of(text: str) -> int:
    """How wide a text is in a terminal."""
    return len(text) if text.isascii() else sum(map(_columns, text))


def _columns(letter: str) -> int:
    return 0 if combining(letter) else 2 if east_asian_width(letter) in "WF" else 1


def padded(text: str, columns: int) -> str:
    """The text, and as many spaces as are missing."""
    return text + " " * (columns - columns_of(text))


def column_of(labels: Iterable[str], at_least: int = 0) -> int:
    """Columns for the widest of them and a space behind it."""
    return max([at_least, *(columns_of(label) + 1 for label in labels if label)])


def labelled(
    lines: Sequence[LabelledLine], at_least: int = 0, width: int = SCREEN
) -> Iterator[str]:
    """Each line with its label in a column of at least so many columns."""
    column = column_of((each.label for each in lines), at_least)
    for each in lines:
        first, *more = _pieces(each, max(FEWEST, width - column))
        yield (padded(each.label, column) + first).rstrip()
        yield from (" " * column + piece for piece in more)


def _pieces(line: LabelledLine, width: int) -> list[str]:
    whole = GAP.join(filter(None, (line.typed, line.text)))
    if columns_of(whole) <= width:
        return [whole]
    if line.typed:
        inner = wrapped(line.text, max(FEWEST, width - len(GAP)))
        return [line.typed, *(GAP + piece for piece in inner)]
    return wrapped(line.text, width)


def wrapped(text: str, width: int = SCREEN) -> list[str]:
    """The text in lines of so many columns; its own lines and their indents stay."""
    return safe_text.wrapped(text, width, columns_of)


def side_by_side(parts: Iterable[str], gap: str, width: int = SCREEN) -> str:
    """The parts in one line; those for which there is no room, in the next."""
    lines: list[str] = []
    for part in parts:
        if lines and columns_of(lines[-1] + gap + part) <= width:
            lines[-1] += gap + part
        else:
            lines.append(part)
    return "\n".join(lines)
