"""What a student has done so far, kept in one small file of the workspace."""

from __future__ import annotations

import fcntl
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import datetime, timezone
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING

from roslings.course import Lab, all_labs
from roslings.workspace.errors import WorkspaceError, reading, writing
from roslings.workspace.progress_file import (
    DamagedProgress,
    DrillProgress,
    LabProgress,
    QuizProgress,
    StudentProgress,
    as_json,
    progress_in,
)
from roslings.workspace.student import started_package, workspace_root

if TYPE_CHECKING:
    from roslings.verdict import Verdict


class NextStep(Enum):
    """What a student does next."""

    START = "start"
    GO_ON = "go on"
    ALL_DONE = "all done"


@dataclass(frozen=True)
class LabStatus:
    """One line of `status`."""

    lab: Lab
    progress: LabProgress
    package: Path | None
    """Where the student's package lies, if there is one."""


@dataclass(frozen=True)
class Today:
    """What is next; `at` is None when all is done."""

    step: NextStep
    at: LabStatus | None


def status(workspace: Path | None = None) -> list[LabStatus]:
    """How far each lab is, in the order of the days.

    A damaged file is set aside first and counts as empty. Raises CannotRead.
    """
    root = workspace or workspace_root()
    done = read_progress(root).labs
    return [
        LabStatus(lab, done.get(lab.name, LabProgress()), _package(lab, root)) for lab in all_labs()
    ]


def days_done(labs: list[LabStatus]) -> dict[str, bool]:
    """Each day with a lab to whether all its labs are done, in order."""
    days: dict[str, bool] = {}
    for each in labs:
        day = each.lab.outline.day
        days[day] = days.get(day, True) and each.progress.done
    return days


def today(workspace: Path | None = None) -> Today:
    """The first lab that is not done and whose needs are."""
    labs = status(workspace)
    done = {each.lab.name for each in labs if each.progress.done}
    ready = (each for each in labs if _is_ready(each.lab, done))
    at = next((each for each in ready if each.lab.name not in done), None)
    if at is None:
        return Today(NextStep.ALL_DONE, None)
    return Today(NextStep.GO_ON if at.package else NextStep.START, at)


def record(verdict: Verdict, workspace: Path | None = None) -> LabProgress:
    """Keep a verdict's score; returns how far the lab is now.

    A verdict without a score (the machine's fault) changes nothing. Raises DiskFull and
    CannotWriteFolder: the caller tells it, and shows the verdict all the same.
    """
    root = workspace or workspace_root()
    if verdict.score is None:
        return read_progress(root).labs.get(verdict.lab, LabProgress())
    with writing(_file(root)), _locked(root):
        progress = read_progress(root).with_day(datetime.now().astimezone().date())
        lab = _after(progress.labs.get(verdict.lab, LabProgress()), verdict, verdict.score)
        progress.labs[verdict.lab] = lab
        _write(_file(root), progress)
    return lab


def record_drill(name: str, passed: bool, workspace: Path | None = None) -> DrillProgress:
    """Keep that a drill was tried, and whether it passed. Raises DiskFull and CannotWriteFolder."""
    root = workspace or workspace_root()
    now = datetime.now(timezone.utc).replace(microsecond=0)
    with writing(_file(root)), _locked(root):
        progress = read_progress(root).with_day(datetime.now().astimezone().date())
        before = progress.drills.get(name, DrillProgress())
        passed_at = before.passed_at or (now if passed else None)
        progress.drills[name] = DrillProgress(before.tries + 1, now, passed_at)
        _write(_file(root), progress)
        return progress.drills[name]


def record_quiz(day: str, right: int, of: int, workspace: Path | None = None) -> QuizProgress:
    """Keep how many questions of a day's quiz were right. Raises DiskFull and CannotWriteFolder.

    The best round is the one with the largest part of its questions right: a quiz may grow.
    """
    root = workspace or workspace_root()
    now = datetime.now(timezone.utc).replace(microsecond=0)
    with writing(_file(root)), _locked(root):
        progress = read_progress(root).with_day(datetime.now().astimezone().date())
        before = progress.quizzes.get(day, QuizProgress())
        better = not before.of or right * before.of >= before.best * of
        best, best_of = (right, of) if better else (before.best, before.of)
        progress.quizzes[day] = QuizProgress(best, best_of, right, before.rounds + 1, now)
        _write(_file(root), progress)
        return progress.quizzes[day]


def read_progress(workspace: Path) -> StudentProgress:
    """The file as it is; empty where there is none, and where a damaged one was set aside."""
    path = _file(workspace)
    with reading(path):
        if not path.is_file():
            return StudentProgress()
        content = path.read_bytes()
    try:
        return progress_in(content)
    except DamagedProgress:
        _set_aside(path)
        return StudentProgress()


def _file(workspace: Path) -> Path:
    return workspace / ".roslings" / "progress.json"


def _package(lab: Lab, root: Path) -> Path | None:
    try:
        return started_package(lab, root)
    except WorkspaceError:  # a folder that cannot be read is the business of `check`
        return None


def _is_ready(lab: Lab, done: set[str]) -> bool:
    return set(lab.outline.needs) <= done


def _after(before: LabProgress, verdict: Verdict, score: float) -> LabProgress:
    now = datetime.now(timezone.utc).replace(microsecond=0)
    better = before.checks == 0 or score > before.best
    passed_at = now if verdict.outcome == "pass" else None
    return LabProgress(
        best=score if better else before.best,
        best_at=now if better else before.best_at,
        last=score,
        last_at=now,
        checks=before.checks + 1,
        passed_at=before.passed_at or passed_at,
    )


@contextmanager
def _locked(workspace: Path) -> Iterator[None]:
    """Two gradings at once write one after the other."""
    folder = _file(workspace).parent
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _write(path: Path, progress: StudentProgress) -> None:
    """Write the whole file, or leave the old one: a full disk must not cost the progress."""
    descriptor, name = tempfile.mkstemp(prefix=".progress-", dir=path.parent)
    new = Path(name)
    try:
        with os.fdopen(descriptor, "w", encoding="utf-8") as file:
            file.write(as_json(progress))
            file.flush()
            os.fsync(file.fileno())
        new.replace(path)
    finally:
        new.unlink(missing_ok=True)


def _set_aside(path: Path) -> None:
    """Give a damaged file another name, so that nothing in it is lost."""
    names = (path.with_name(f"progress-damaged-{number}.json") for number in range(1, 1000))
    with writing(path):
        path.rename(next(name for name in names if not name.exists()))
