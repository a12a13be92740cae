"""`./roslings status`: which days, labs, drills and quizzes are done."""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from ros2_on_pip.errors import OK
from roslings.way import (
    FIRST_DAY,
    bar,
    best_quiz_of,
    drills_of,
    how_far,
    how_far_is_the_first_day,
)
from roslings.workspace import progress


def add_options(word: argparse.ArgumentParser) -> None:
    """Nothing."""


def run(options: argparse.Namespace) -> int:
    """Show days, labs and drills done."""
    print("\n".join(lines()))
    return OK


def lines() -> Iterator[str]:
    """A line for each lab, with its day, the drills and the quiz of that day; then all, counted."""
    labs = progress.status()
    day_width = 1 + max(len(each.lab.outline.day) for each in labs)
    lab_width = 1 + max(len(each.lab.name) for each in labs)
    yield _line("day", "drills", "quiz", day_width, "lab")
    yield _of_day(FIRST_DAY, day_width, how_far_is_the_first_day(labs))
    day = FIRST_DAY
    for each in labs:
        told = f"{each.lab.name:{lab_width}}{how_far(each)}"
        if each.lab.outline.day == day:  # its second lab
            yield _line("", "", "", day_width, told)
        else:
            yield _of_day(day := each.lab.outline.day, day_width, told)
    yield from ("", bar(labs))


def _of_day(day: str, day_width: int, told: str) -> str:
    return _line(day, drills_of(day), best_quiz_of(day), day_width, told)


def _line(day: str, drills: str, quiz: str, day_width: int, told: str) -> str:
    return f"{day:{day_width}}{drills:7}{quiz:6}{told}"
