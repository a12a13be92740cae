"""The package of a lab's best score, kept: what is tried later spoils nothing of it."""

from __future__ import annotations

import shutil
from contextlib import suppress
from pathlib import Path

from roslings.course import Lab
from roslings.workspace.copying import copy_package
from roslings.workspace.student import workspace_root

FOLDER = Path(".roslings/best")


def keep_best(lab: Lab, package: Path, score: float | None) -> None:
    """Keep a copy, where no better one is kept; of two with one score, the later.

    Raises WorkspaceError where the disk refuses it: what was kept stays.
    """
    if score is None or score < _score(lab):
        return
    place = _place(lab)
    new = place.with_name(f"{lab.name}-new")
    shutil.rmtree(new, ignore_errors=True)
    copy_package(package, new / lab.outline.package)
    (new / "score").write_text(f"{score:g}\n", "utf-8")
    shutil.rmtree(place, ignore_errors=True)
    new.rename(place)


def best_package(lab: Lab) -> Path | None:
    """Where it is kept; None where none was checked yet."""
    package = _place(lab) / lab.outline.package
    return package if package.is_dir() else None


def _score(lab: Lab) -> float:
    with suppress(OSError, ValueError):
        return float((_place(lab) / "score").read_text("utf-8"))
    return -1.0


def _place(lab: Lab) -> Path:
    return workspace_root() / FOLDER / lab.name
