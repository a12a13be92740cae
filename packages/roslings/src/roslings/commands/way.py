"""Where a learner is on the way through the course, and what comes next."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.label_column import LabelledLine, labelled, padded, side_by_side, wrapped
from ros2_on_pip.language import Text, counted, said
from ros2_on_pip.typed_paths import from_here
from roslings import course
from roslings.commands.invocation import program
from roslings.course.titles import lab_title
from roslings.workspace import progress
from roslings.workspace.student import workspace_root
from roslings_rover.remembered import has_reached_a_ball

if TYPE_CHECKING:
    from roslings.course import Lab
    from roslings.workspace.progress import LabStatus, Today

FIRST_DAY = "01-install"
FIRST_PAGE = "first-15-minutes.md"
ALL_DONE = Text("today.all_done", "All labs are done. Well done!")
LESSON_ONE = Text("today.lesson_one", "the lesson of day 1, in JupyterLab")
READ, NEXT = Text("today.label.read", "Read"), Text("today.label.next", "Next")
THEN = Text("today.label.then", "Then")
LABELS = 6
"""Columns for labels, where none is longer."""
BAR_COLUMNS = 14
FULL, EMPTY = "#", "."
"""Of the bar; a screen reader says them, and every terminal has them."""


def next_lines(labs: list[LabStatus], next_step: Today) -> Iterator[str]:
    """What to type, in the order in which it is done."""
    if next_step.at is None:
        yield str(ALL_DONE)
        lines = []
    elif _has_begun(labs):
        yield from wrapped(_heading(next_step.at))
        lines = list(_lines_of_lab(labs, next_step, next_step.at.lab))
    else:
        lines = list(_first_lines(next_step.at.lab))
    yield from labelled([*lines, _all_commands()], LABELS)


def _heading(at: LabStatus) -> str:
    day, title = at.lab.outline.day, lab_title(at.lab)
    heading = "Day {day}: {title}  ({how_far})"
    return said("today.day", heading, day=day, title=title, how_far=how_far(at))


def _lines_of_lab(labs: list[LabStatus], next_step: Today, lab: Lab) -> Iterator[LabelledLine]:
    lesson = said("today.the_lesson", "the lesson")
    yield LabelledLine(str(READ), lesson, f"{program()} lab {int(lab.outline.day[:2])}")
    drill = drill_before(lab)
    if drill:
        told = said("today.drills", "drills come before the lab; now: {drill}", drill=drill)
        yield LabelledLine(str(NEXT), told, f"{program()} watch")
    verb = "start" if next_step.step is progress.NextStep.START else "check"
    yield LabelledLine(str(THEN if drill else NEXT), typed=f"{program()} {verb} {lab.name}")
    yield LabelledLine(said("today.task", "Task"), typed=from_here(lab.task))
    if any(each.progress.checks for each in labs):
        told = said("today.my_rover", "what your packages do together")
        yield LabelledLine(said("today.robot", "Robot"), told, f"{program()} my-rover")


def _first_lines(lab: Lab) -> Iterator[LabelledLine]:
    """Before the first drill and the first lab."""
    lesson = f"{program()} lab 1"
    if has_reached_a_ball():
        told = "The first 15 minutes: the rover has touched the ball."
        yield LabelledLine(said("today.done", "Done"), said("today.first_page_done", told))
        yield LabelledLine(str(NEXT), str(LESSON_ONE), lesson)
    else:
        told = "The first 15 minutes: drive a robot, find a mistake."
        yield LabelledLine(said("today.now", "Now"), said("today.first_page", told))
        read = said("today.read", "Read {page}", page=from_here(_first_page()))
        yield LabelledLine("", typed=read)
        yield LabelledLine(str(THEN), str(LESSON_ONE), lesson)
    if drill_before(lab):
        told = said("today.first_drills", "the first drills, and then the first lab")
        yield LabelledLine(str(THEN), told, f"{program()} watch")
    else:
        told = said("today.first_lab", "the first lab")
        yield LabelledLine(str(THEN), told, f"{program()} start {lab.name}")


def _all_commands() -> LabelledLine:
    typed = f"{program()} --help      {program()} status"
    return LabelledLine(said("today.all", "All"), typed=typed)


def _first_page() -> Path:
    return course.root() / "days" / FIRST_DAY / FIRST_PAGE


def _has_begun(labs: list[LabStatus]) -> bool:
    tried = progress.read_progress(workspace_root()).drills
    return bool(tried) or any(each.package or each.progress.checks for each in labs)


def bar(labs: list[LabStatus]) -> str:
    """How much is done: `Labs  ####....  2 of 7   Drills  #...  9 of 70   3 days in a row`."""
    kept = progress.read_progress(workspace_root())
    done, of = _drills_done()
    labs_done = sum(each.progress.done for each in labs)
    parts = [_one_bar(said("today.labs", "Labs"), labs_done, len(labs))]
    if of:
        parts.append(_one_bar(said("today.drills_done", "Drills"), done, of))
    if (row := kept.days_in_a_row(datetime.now().astimezone().date())) > 1:
        one, other = "{count} day in a row", "{count} days in a row"
        parts.append(counted("today.days_in_a_row", row, one=one, other=other))
    return side_by_side(parts, "   ")


def _one_bar(name: str, done: int, of: int) -> str:
    full = BAR_COLUMNS * done // of
    count = said("today.count", "{done} of {of}", done=done, of=of)
    label = padded(f"{name} ", LABELS)
    return f"{label}{FULL * full + EMPTY * (BAR_COLUMNS - full)}  {count}"


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
        return said("status.works", "your installation works")
    if has_reached_a_ball():
        return said("status.first_page_done", "the first page is done")
    return said("status.first_page", "first: {page}", page=FIRST_PAGE)


def how_far(each: LabStatus) -> str:
    """Of a lab: its scores, or that it is not begun."""
    if each.progress.checks:
        best, last = each.progress.best, each.progress.last
        if each.progress.done:
            done = "done (best {best:g} of 100, last {last:g})"
            return said("status.done", done, best=best, last=last)
        return said("status.tried", "best {best:g} of 100, last {last:g}", best=best, last=last)
    if each.package:
        return said("status.not_checked", "begun, not yet checked")
    return said("status.not_begun", "not begun")
