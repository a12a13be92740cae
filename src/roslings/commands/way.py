"""Where a learner is on the way through the course, and what comes next."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from roslings import course
from roslings.commands.showing import from_here
from roslings.exits import OK
from roslings.typed import program
from roslings.workspace import progress
from roslings.workspace.student import workspace_root

if TYPE_CHECKING:
    from roslings.workspace.progress import LabStatus, Today

FIRST_DAY = "01-install"
FIRST_PAGE = "first-15-minutes.md"
BAR_COLUMNS = 24
FULL, EMPTY = "#", "."
"""Of the bar; a screen reader says them, and every terminal has them."""


def today(options: argparse.Namespace) -> int:
    """Say what is next."""
    labs = progress.status()
    print("\n".join([bar(labs), "", *_next(labs, progress.today())]))
    print(f"{'All':6}{program()} --help      {program()} status")
    return OK


def status(options: argparse.Namespace) -> int:
    """Show days and labs done."""
    labs = progress.status()
    day_width = 2 + max(len(each.lab.outline.day) for each in labs)
    lab_width = 2 + max(len(each.lab.name) for each in labs)
    day = FIRST_DAY
    print(f"{day:{day_width}}{'':{lab_width}}{_how_far_is_the_first_day(labs)}")
    for each in labs:
        shown = "" if each.lab.outline.day == day else each.lab.outline.day
        day = each.lab.outline.day
        print(f"{shown:{day_width}}{each.lab.name:{lab_width}}{_how_far(each)}")
    print(f"\n{bar(labs)}")
    return OK


def _next(labs: list[LabStatus], next_step: Today) -> Iterator[str]:
    """What to type, in the order in which it is done."""
    if next_step.at is None:
        yield "All labs are done. Well done!"
        return
    lab = next_step.at.lab
    if not _has_begun(labs):
        yield f"{'Now':6}The first 15 minutes: drive a robot, nine commands."
        yield f"{'':6}Read {from_here(_first_page())}"
        yield f"{'Then':6}{program()} lab 1    the lesson of day 1, in JupyterLab"
        yield f"{'Then':6}{program()} start {lab.name}    the first lab"
        return
    yield f"Day {lab.outline.day}: {lab.outline.title}  ({_how_far(next_step.at)})"
    yield f"{'Read':6}{program()} lab {int(lab.outline.day[:2])}    the lesson"
    verb = "start" if next_step.step is progress.Step.START else "check"
    yield f"{'Next':6}{program()} {verb} {lab.name}"
    yield f"{'Task':6}{from_here(lab.task)}"


def _first_page() -> Path:
    return course.root() / "days" / FIRST_DAY / FIRST_PAGE


def _has_begun(labs: list[LabStatus]) -> bool:
    return any(each.package or each.progress.checks for each in labs)


def bar(labs: list[LabStatus]) -> str:
    """How much is done: `Labs  ####....  2 of 7   3 days in a row`."""
    done = sum(each.progress.done for each in labs)
    full = round(BAR_COLUMNS * done / len(labs))
    kept = progress.read_progress(workspace_root())
    row = kept.days_in_a_row(datetime.now().astimezone().date())
    streak = f"   {row} days in a row" if row > 1 else ""
    bar = FULL * full + EMPTY * (BAR_COLUMNS - full)
    return f"{'Labs':6}{bar}  {done} of {len(labs)}{streak}"


def _how_far_is_the_first_day(labs: list[LabStatus]) -> str:
    """Who has had a package checked has an installation that works."""
    if any(each.progress.checks for each in labs):
        return "done: your installation builds and runs nodes"
    return f"no lab; begin with {from_here(_first_page())}"


def _how_far(each: LabStatus) -> str:
    if not each.progress.checks:
        return "begun, not yet checked" if each.package else "not begun"
    best = f"best {each.progress.best:g} of 100, last {each.progress.last:g}"
    return f"done ({best})" if each.progress.done else best
