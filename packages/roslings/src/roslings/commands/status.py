"""`./roslings status`: which days, labs, drills and quizzes are done."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from ros2_on_pip.errors import OK
from ros2_on_pip.label_column import LabelledLine, column_of, columns_of, labelled, padded
from ros2_on_pip.language import said
from roslings.commands.way import (
    FIRST_DAY,
    bar,
    best_quiz_of,
    drills_of,
    how_far,
    how_far_is_the_first_day,
)
from roslings.workspace import progress

if TYPE_CHECKING:
    from roslings.workspace.progress import LabStatus


def add_options(word: argparse.ArgumentParser) -> None:
    """Nothing."""


def run(options: argparse.Namespace) -> int:
    """Show days, labs and drills done."""
    print("\n".join(lines()))
    return OK


def lines() -> Iterator[str]:
    """A line for each lab, with its day, the drills and the quiz of that day; then all, counted."""
    yield from _table([*_rows(progress.status())])
    yield from ("", bar(progress.status()))


class StatusRow(NamedTuple):
    """One line of the table."""

    day: str
    drills: str
    quiz: str
    lab: str
    how_far: str


def _rows(labs: list[LabStatus]) -> Iterator[StatusRow]:
    yield StatusRow(
        said("status.column.day", "day"),
        said("status.column.drills", "drills"),
        said("status.column.quiz", "quiz"),
        said("status.column.lab", "lab"),
        "",
    )
    yield _of_day(FIRST_DAY, "", how_far_is_the_first_day(labs))
    day = FIRST_DAY
    for each in labs:
        if each.lab.outline.day == day:  # its second lab
            yield StatusRow("", "", "", each.lab.name, how_far(each))
        else:
            yield _of_day(day := each.lab.outline.day, each.lab.name, how_far(each))


def _of_day(day: str, lab: str, told: str) -> StatusRow:
    return StatusRow(day, drills_of(day), best_quiz_of(day), lab, told)


def _table(rows: list[StatusRow]) -> Iterator[str]:
    """Each column as wide as what stands in it; what was reached is wrapped in its own."""
    days, drills, quizzes, labs, _ = zip(*rows, strict=True)
    at_least = column_of(days), column_of(drills, 7), column_of(quizzes, 6)
    ends = column_of(labs)
    for row in rows:
        line = "".join(map(padded, row[:3], at_least)) + padded(row.lab, ends if row.lab else 0)
        yield from labelled([LabelledLine(line.rstrip(), row.how_far)], columns_of(line))
