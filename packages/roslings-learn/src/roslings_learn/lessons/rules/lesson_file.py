"""One lesson.ipynb as its rules see it: cells in order, each in its section."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from roslings_learn.lessons.path import Day
from roslings_learn.lessons.rules.prose import Block, blocks_of, slug


class NoLesson(Exception):
    """The file is no notebook that can be read."""

    def __init__(self, path: Path, why: str) -> None:
        super().__init__(f"{path}: {why}\n    Mend: write it again with jupytext --to ipynb.")


@dataclass(frozen=True, order=True)
class BrokenRule:
    """A rule that a lesson breaks: where, what, and how to mend it."""

    path: Path
    place: int
    """The number of the cell; -1 for the whole lesson."""
    cell: str
    line: int
    """In the cell, counted from 1."""
    what: str
    mend: str

    def __str__(self) -> str:
        where = f"cell {self.cell}, line {self.line}: " if self.place >= 0 else ""
        return f"{self.path}: {where}{self.what}\n    Mend: {self.mend}"


@dataclass(frozen=True)
class Heading:
    """A heading of the lesson."""

    level: int
    text: str
    line: int

    @property
    def slug(self) -> str:
        """Its anchor."""
        return slug(self.text)


@dataclass(frozen=True)
class LessonCell:
    """One cell."""

    place: int
    id: str
    kind: str
    text: str
    tags: tuple[str, ...] = ()
    answer: tuple[tuple[str, str], ...] = ()
    raw: dict[str, Any] = field(default_factory=dict, repr=False, compare=False)

    @property
    def is_code(self) -> bool:
        """It runs."""
        return self.kind == "code"

    @cached_property
    def blocks(self) -> tuple[Block, ...]:
        """Paragraphs, items, tables, code of a Markdown cell."""
        return () if self.is_code else tuple(blocks_of(self.text))

    @property
    def headings(self) -> list[Heading]:
        """The headings in it."""
        return [Heading(b.level, b.text, b.line) for b in self.blocks if b.kind == "heading"]

    def answered(self) -> str:
        """The code after the right edit. Raises ValueError where an old text is not there once."""
        text = self.text
        for old, new in self.answer:
            if text.count(old) != 1:
                raise ValueError(f"{old!r} stands in the cell {text.count(old)} times")
            text = text.replace(old, new)
        return text


@dataclass(frozen=True)
class SectionBlock:
    """A block of prose, and the section that it stands in."""

    cell: LessonCell
    block: Block
    section: str
    """The text of its H2; empty before the first."""
    under: str
    """The text of the nearest heading, H2 or H3."""


@dataclass(frozen=True)
class Lesson:
    """A whole lesson."""

    path: Path
    day: Day
    cells: tuple[LessonCell, ...]
    raw: dict[str, Any] = field(repr=False)

    @cached_property
    def parts(self) -> tuple[SectionBlock, ...]:
        """Every block of its Markdown cells, in order."""
        return tuple(self._parts())

    def _parts(self) -> Iterator[SectionBlock]:
        section = under = ""
        for cell in self.cells:
            for block in cell.blocks:
                if block.kind == "heading":
                    under = block.text if block.level >= 2 else ""
                    section = block.text if block.level == 2 else section
                yield SectionBlock(cell, block, section, under)

    @cached_property
    def sections(self) -> dict[str, tuple[LessonCell, ...]]:
        """H2 to its cells, in order; a cell counts for the last H2 in it or before it."""
        found: dict[str, list[LessonCell]] = {"": []}
        now = ""
        for cell in self.cells:
            titles = [each.text for each in cell.headings if each.level == 2]
            for now in titles:
                found.setdefault(now, [])
            found[titles[0] if titles else now].append(cell)
        return {title: tuple(cells) for title, cells in found.items()}

    @property
    def headings(self) -> list[tuple[LessonCell, Heading]]:
        """Every heading with its cell."""
        return [(cell, each) for cell in self.cells for each in cell.headings]

    @property
    def anchors(self) -> frozenset[str]:
        """What a link may point to."""
        return frozenset(each.slug for _, each in self.headings)

    def broken(self, what: str, mend: str) -> BrokenRule:
        """A rule that the lesson as a whole breaks."""
        return BrokenRule(self.path, -1, "", 0, what, mend)

    def broken_at(self, cell: LessonCell, line: int, what: str, mend: str) -> BrokenRule:
        """A rule broken at a line of a cell."""
        return BrokenRule(
            self.path, cell.place, cell.id or f"number {cell.place + 1}", line, what, mend
        )


def read_lesson(path: Path, day: Day) -> Lesson:
    """Read a notebook. Raises NoLesson."""
    try:
        raw = json.loads(path.read_text("utf-8"))
        cells = tuple(_cell(place, each) for place, each in enumerate(raw["cells"]))
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise NoLesson(path, f"this is no notebook ({error}).") from error
    return Lesson(path, day, cells, raw)


def _cell(place: int, raw: dict[str, Any]) -> LessonCell:
    metadata = raw.get("metadata", {})
    answer = metadata.get("roslings", {}).get("answer", [])
    source = raw["source"]
    return LessonCell(
        place,
        raw.get("id", ""),
        raw["cell_type"],
        source if isinstance(source, str) else "".join(source),
        tuple(metadata.get("tags", ())),
        tuple((str(old), str(new)) for old, new in answer),
        raw,
    )
