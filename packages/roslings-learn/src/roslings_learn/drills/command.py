"""`./roslings drill`: the next drill, a check of one, a hint, the list."""

from __future__ import annotations

import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.language import said
from roslings.report.often_said import GO_ON, NEXT
from roslings.report.page import Page
from roslings.seen.timeline import NS_PER_S, process_began_ns
from roslings.workspace.errors import WorkspaceError
from roslings.workspace.progress import record_drill
from roslings.workspace.student import workspace_root
from roslings_learn.drills import telling
from roslings_learn.drills.course import Drill, all_drills, drill
from roslings_learn.drills.judging import DrillVerdict
from roslings_learn.drills.student import DrillStatus, file_of, next_drill, start, statuses


@dataclass(frozen=True)
class DrillOptions:
    """What was typed behind `drill`."""

    program: str
    name: str | None = None
    hint: int | None = None
    day: str | None = None
    solution: bool = False
    list: bool = False


def run(asked: DrillOptions) -> DrillVerdict | None:
    """Do it, and show it; the verdict where one was given."""
    page = telling.page()
    verdict = None
    if asked.list:
        telling.put_list(page, statuses())
    elif asked.name is None:
        _put_next(page, asked)
    elif asked.hint:
        telling.put_hint(page, drill(asked.name), asked.hint, asked.program)
    else:
        verdict = _check(page, drill(asked.name), asked)
    page.print()
    return verdict


def _put_next(page: Page, asked: DrillOptions) -> None:
    """Put the next drill into the workspace, and show it."""
    status = next_drill(day=asked.day)
    if status is None:
        page.line(said("drill.all_done", "All drills are done."), "bold")
        page.command(NEXT, GO_ON, asked.program)
        return
    _put_task(page, status, asked)


def _put_task(page: Page, status: DrillStatus, asked: DrillOptions) -> None:
    names = [each.name for each in all_drills()]
    file, _ = start(status.drill)
    place = (names.index(status.drill.name) + 1, len(names))
    telling.put_task(page, status.drill, file, place, telling.WayToGoOn(asked.program))


def _check(page: Page, one: Drill, asked: DrillOptions) -> DrillVerdict | None:
    if asked.solution:
        file = one.solution
    elif not os.path.lexists(file := file_of(one)):
        _put_task(page, DrillStatus(one, 0, False, None), asked)
        return None
    began_s = process_began_ns() / NS_PER_S
    verdict = checked(one, file, began_s, kept=not asked.solution)
    telling.put_verdict(page, one, verdict, file, telling.WayToGoOn(asked.program))
    if verdict.outcome == "pass" and not asked.solution:
        page.command(NEXT, said("drill.next", "The next drill:"), f"{asked.program} drill")
    return verdict


def checked(
    one: Drill, file: Path, began_s: float | None = None, kept: bool = True
) -> DrillVerdict:
    """The verdict on the student's file, which is kept in the progress. Raises RunBrokeOff."""
    from roslings_learn.drills.running import check

    verdict = check(one, file, time.monotonic() if began_s is None else began_s)
    if kept and verdict.outcome != "inconclusive" and workspace_root().is_dir():
        try:
            record_drill(one.name, verdict.outcome == "pass")
        except WorkspaceError as error:
            told = said("drill.not_kept", "roslings: the drill was not kept. {why}", why=error)
            print(told, file=sys.stderr)
    return verdict
