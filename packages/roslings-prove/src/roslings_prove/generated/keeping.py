"""Grading many wrong packages, and keeping what came of each: an interrupted run goes on."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path

from roslings.experiment.run_folder import run_folder
from roslings_class.alone import alone_in
from roslings_class.errors import BatchError
from roslings_class.gradebook import gradebook
from roslings_class.result import GradingResult
from roslings_class.scheduler import Watcher
from roslings_prove.generated.graded_process import ENTRY_POINT
from roslings_prove.generated.packages import GeneratedPackage
from roslings_prove.generated.wrongness import W
from roslings_prove.prove import Proof, graded, mixed

BOOK = "labs"


class AlreadyProving(BatchError):
    """Another command keeps its results there."""

    def __init__(self, folder: Path) -> None:
        problem = f"Another ./roslings prove keeps its results in {folder} now."
        super().__init__(problem, "Wait for it, or give another folder: --keep DIR")


def graded_in(
    packages: Collection[GeneratedPackage[W]],
    watcher: Watcher,
    jobs: int | None,
    kept: Path,
    entry_point: str = ENTRY_POINT,
) -> Mapping[str, GradingResult]:
    """Package's name to what came of it; results stay in a folder. Raises AlreadyProving."""
    with alone_in(kept, AlreadyProving), run_folder() as scratch:
        return graded(
            mixed(packages),
            scratch,
            watcher,
            jobs,
            book=str(kept.absolute()),
            keeps_evidence=True,
            entry_point=entry_point,
        )


def kept_in(folder: Path) -> Mapping[str, GradingResult]:
    """What an earlier run has found."""
    folder.mkdir(parents=True, exist_ok=True)
    with gradebook(folder, BOOK) as book:
        return book.latest()


def how_far(
    packages: Collection[GeneratedPackage[W]], results: Mapping[str, GradingResult]
) -> Proof:
    """Nothing is proven by a part of them."""
    done = sum(each.name in results for each in packages)
    rest = "" if done == len(packages) else "only they are counted: run it without --so-far"
    return Proof(f"{done} of {len(packages)} packages are graded", rest, is_open=True)
