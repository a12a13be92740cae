"""The student's own files: one for each drill that was begun, in `drills/` of the workspace."""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from roslings.workspace.errors import NotAFile, NotThere, reading, writing
from roslings.workspace.progress import read_progress
from roslings.workspace.progress_file import DrillProgress
from roslings.workspace.student import workspace_root
from roslings_learn.drills.course import Drill, all_drills

FOLDER = "drills"


@dataclass(frozen=True)
class DrillStatus:
    """How far one drill is."""

    drill: Drill
    tries: int
    done: bool
    file: Path | None
    """The student's file, where there is one."""


def file_of(drill: Drill, workspace: Path | None = None) -> Path:
    """Where the student's file for a drill lies, or will lie."""
    return (workspace or workspace_root()) / FOLDER / drill.day / drill.file_name


def program_in(file: Path, drill: Drill) -> bytes:
    """The student's program. Raises NotThere, NotAFile, CannotRead."""
    with reading(file):
        try:
            return file.read_bytes()
        except (FileNotFoundError, NotADirectoryError):
            raise NotThere(file, f"./roslings drill {drill.name}") from None
        except OSError:
            if file.is_file():
                raise
            raise NotAFile(file) from None


def start(drill: Drill, workspace: Path | None = None) -> tuple[Path, bool]:
    """Put the starter into the workspace, never over what is there; file, and whether it is new.

    What runs beside it comes along, so that it can be run by hand. Raises DiskFull,
    CannotWriteFolder.
    """
    file = file_of(drill, workspace)
    _put_companion(drill, file.parent)
    if file.exists():
        return file, False
    with writing(file):
        file.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(drill.starter, file)
    return file, True


def is_changed(drill: Drill, workspace: Path | None = None) -> bool:
    """Whether the student's file is another than the starter, or is not there."""
    try:
        return file_of(drill, workspace).read_bytes() != drill.starter.read_bytes()
    except OSError:  # what stands there is no file, or cannot be read
        return True


def begin_again(drill: Drill, workspace: Path | None = None) -> Path:
    """Put the starter back in place of the student's file; where that is kept.

    Raises DiskFull, CannotWriteFolder.
    """
    file = file_of(drill, workspace)
    kept = _free_name(file)
    with writing(file):
        if os.path.lexists(file):
            file.rename(kept)
    start(drill, workspace)
    return kept


def _free_name(file: Path) -> Path:
    """Of files with another ending, so that no drill and no editor takes it for the program."""
    names = (file.with_name(f"{file.name}.yours{number}") for number in ("", *range(2, 1000)))
    return next(name for name in names if not os.path.lexists(name))


def _put_companion(drill: Drill, folder: Path) -> None:
    """The program that the drill runs beside the student's."""
    if drill.card.beside and not (folder / drill.card.beside.file).exists():
        with writing(folder):
            folder.mkdir(parents=True, exist_ok=True)
            shutil.copy(drill.folder / drill.card.beside.file, folder)


def statuses(workspace: Path | None = None) -> list[DrillStatus]:
    """How far each drill is, in the order of the path."""
    root = workspace or workspace_root()
    done = read_progress(root).drills
    return [_status(each, done, root) for each in all_drills()]


def _status(drill: Drill, done: Mapping[str, DrillProgress], root: Path) -> DrillStatus:
    found = done.get(drill.name, DrillProgress())
    file = file_of(drill, root)
    passed = found.passed_at is not None
    return DrillStatus(drill, found.tries, passed, file if file.is_file() else None)


def next_drill(workspace: Path | None = None, day: str | None = None) -> DrillStatus | None:
    """The first drill that is not done, of a day or of all; None when all are."""
    every = statuses(workspace)
    return next((s for s in every if not s.done and day in (None, s.drill.day)), None)
