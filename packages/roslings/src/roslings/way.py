"""Where a learner is on the way through the course, and what comes next."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.typed_paths import from_here
from roslings import course
from roslings.typed import program
from roslings.workspace import progress
from roslings.workspace.student import workspace_root
from roslings_rover.remembered import has_reached_a_ball

if TYPE_CHECKING:
    from roslings.course import Lab
    from roslings.workspace.progress import LabStatus, Today

FIRST_DAY = "01-install"
FIRST_PAGE = "first-15-minutes.md"
LESSON_ONE = "the lesson of day 1, in JupyterLab"
BAR_COLUMNS = 14
FULL, EMPTY = "#", "."
"""Of the bar; a screen reader says them, and every terminal has them."""


def next_lines(labs: list[LabStatus], next_step: Today) -> Iterator[str]:
    """What to type, in the order in which it is done."""
    if next_step.at is None:
        yield "All labs are done. Well done!"
        return
    lab = next_step.at.lab
    if not _has_begun(labs):
        yield from _first_lines(lab)
        return
    yield f"Day {lab.outline.day}: {lab.outline.title}  ({how_far(next_step.at)})"
    yield f"{'Read':6}{program()} lab {int(lab.outline.day[:2])}    the lesson"
    if drill := drill_before(lab):
        yield f"{'Next':6}{program()} watch    drills come before the lab; now: {drill}"
    verb = "start" if next_step.step is progress.Step.START else "check"
    yield f"{'Then' if drill else 'Next':6}{program()} {verb} {lab.name}"
    yield f"{'Task':6}{from_here(lab.task)}"
    if any(each.progress.checks for each in labs):
        yield f"{'Robot':6}{program()} my-rover    what your packages do together"


def _first_lines(lab: Lab) -> Iterator[str]:
    """Before the first drill and the first lab."""
    if has_reached_a_ball():
        yield f"{'Done':6}The first 15 minutes: the rover has touched the ball."
        yield f"{'Next':6}{program()} lab 1    {LESSON_ONE}"
    else:
        yield f"{'Now':6}The first 15 minutes: drive a robot, find a mistake."
        yield f"{'':6}Read {from_here(_first_page())}"
        yield f"{'Then':6}{program()} lab 1    {LESSON_ONE}"
    if drill_before(lab):
        yield f"{'Then':6}{program()} watch    the first drills, and then the first lab"
    else:
        yield f"{'Then':6}{program()} start {lab.name}    the first lab"


def _first_page() -> Path:
    return course.root() / "days" / FIRST_DAY / FIRST_PAGE


def _has_begun(labs: list[LabStatus]) -> bool:
    tried = progress.read_progress(workspace_root()).drills
    return bool(tried) or any(each.package or each.progress.checks for each in labs)


def bar(labs: list[LabStatus]) -> str:
    """How much is done: `Labs  ####....  2 of 7   Drills  #...  9 of 70   3 days in a row`."""
    kept = progress.read_progress(workspace_root())
    done, of = _drills_done()
    parts = [_one_bar("Labs", sum(each.progress.done for each in labs), len(labs))]
    if of:
        parts.append(_one_bar("Drills", done, of))
    if (row := kept.days_in_a_row(datetime.now().astimezone().date())) > 1:
        parts.append(f"{row} days in a row")
    return "   ".join(parts)


def _one_bar(name: str, done: int, of: int) -> str:
    full = BAR_COLUMNS * done // of
    return f"{name + ' ':6}{FULL * full + EMPTY * (BAR_COLUMNS - full)}  {done} of {of}"


def _drills_done(day: str = "") -> tuple[int, int]:
    """How many are mended, and how many there are: of one day, or of all."""
    left, there = drills_left(), drills_there()
    of = sum(day in ("", each) for each, _ in there)
    return of - sum(day in ("", each) for each, _ in left), of


def drills_of(day: str) -> str:
    """How many drills of a day are mended: `3/10`; `-` where it has none."""
    done, of = _drills_done(day)
    return f"{done}/{of}" if of else "-"


def best_quiz_of(day: str) -> str:
    """The best score in the quiz of a day: `9/12`; `-` where it was never answered."""
    kept = progress.read_progress(workspace_root()).quizzes.get(day)
    return f"{kept.best}/{kept.of}" if kept else "-"


def drills_there() -> list[tuple[str, str]]:
    """Day and name of each drill, by their folders alone: a card is read by who needs it."""
    cards = (course.root() / "days").glob("*/drills/[0-9][0-9]_*/drill.yaml")
    folders = sorted(card.parent for card in cards)
    return [(folder.parents[1].name, folder.name[3:]) for folder in folders]


def drills_left() -> list[tuple[str, str]]:
    """Day and name of each drill that is not done, in the order of the path."""
    done = progress.read_progress(workspace_root()).drills
    return [
        (day, name) for day, name in drills_there() if not (name in done and done[name].passed_at)
    ]


def drill_before(lab: Lab) -> str | None:
    """The next drill up to this lab's day; None where all of them are done."""
    return next((name for day, name in drills_left() if day <= lab.outline.day), None)


def how_far_is_the_first_day(labs: list[LabStatus]) -> str:
    """It has no lab; who has had a package checked has an installation that works."""
    if any(each.progress.checks for each in labs):
        return "your installation works"
    if has_reached_a_ball():
        return "the first page is done"
    return f"first: {FIRST_PAGE}"


def how_far(each: LabStatus) -> str:
    """Of a lab: its scores, or that it is not begun."""
    if not each.progress.checks:
        return "begun, not yet checked" if each.package else "not begun"
    best = f"best {each.progress.best:g} of 100, last {each.progress.last:g}"
    return f"done ({best})" if each.progress.done else best
