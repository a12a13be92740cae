"""Called in the command's process: have a package measured behind the machine's best wall."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from roslings.arena import Isolation, choose_isolation
from roslings.evidence import Evidence, PackageSeen
from roslings.experiment.assignment import Assignment
from roslings.experiment.begin import Begin, Begun, in_a_fresh_python
from roslings.experiment.declare import Clock
from roslings.experiment.run_folder import run_folder
from roslings.workspace.student import stage
from roslings.workspace.trouble import DiskFull

ENDS_WITHIN_S = 30.0
LAST_WORDS = 20
ROOM_NEEDED_BYTES = 1024 * 1024


class MeasuringFailed(Exception):
    """The measuring process itself ended without evidence: the machine's fault, or ours."""

    def __init__(self, status: int, last_words: str) -> None:
        self.status, self.last_words = status, last_words
        super().__init__(f"The measurement broke off (status {status}).\n{last_words}".rstrip())


@dataclass(frozen=True)
class Choices:
    """How to measure."""

    seed: int
    """Of all that a student cannot know before: sentences, distances, goals."""
    clock: Clock = "auto"
    bags: Path | None = None
    """A new folder for what was said, one bag an experiment."""
    port: Path | None = None
    """The serial port of a real board, in place of the one in Python."""
    hidden: Path | None = None
    """A grader's file that students do not have."""
    builds: Path | None = None
    """A folder in which packages of equal content share one build."""
    begin: Begin = in_a_fresh_python
    """How the measuring process begins."""


def measure(
    lab: str, package: Path, seen: PackageSeen, choices: Choices, on_step: Callable[[str], None]
) -> Evidence:
    """Build and run the package at `package`; `on_step` is told what happens.

    Raises MeasuringFailed, and whatever staging a copy of the package raises.
    """
    with run_folder() as folder:
        wall = choose_isolation()
        assignment = Assignment(
            lab=lab, seed=choices.seed, wall=wall.wall, sandbox=wall.sandbox,
            clock=choices.clock, folder=folder,
            package=seen, keeps_bags=choices.bags is not None, port=choices.port,
            hidden=choices.hidden, builds=choices.builds,
        )  # fmt: skip
        assignment.make_folders()
        stage(package, folder / "src" / seen.name)
        _follow(choices.begin, assignment, wall, on_step)
        evidence = Evidence.model_validate_json(assignment.evidence.read_text("utf-8"))
        if choices.bags is not None and assignment.bags.is_dir():
            shutil.copytree(assignment.bags, choices.bags)
    if wall.because:
        evidence.advice.append(f"Measured without a network of its own: {wall.because}.")
    return evidence


def _follow(
    begin: Begin, order: Assignment, walls: Isolation, on_step: Callable[[str], None]
) -> None:
    """Follow the measuring process to its end. Raises MeasuringFailed, DiskFull."""
    folder = order.folder
    errors = folder / "stderr"
    with errors.open("wb") as stderr, _ended(begin(order, walls, stderr.fileno())) as process:
        assert process.stdout is not None
        for line in process.stdout:
            on_step(line.rstrip())
        status = process.wait()
    if status:
        if shutil.disk_usage(folder).free < ROOM_NEEDED_BYTES:
            raise DiskFull(folder)
        words = errors.read_text("utf-8", errors="replace").splitlines()[-LAST_WORDS:]
        raise MeasuringFailed(status, "\n".join(words))


@contextmanager
def _ended(process: Begun) -> Iterator[Begun]:
    """A process that ends with the block, after it has ended all that it started."""
    try:
        yield process
    finally:
        if process.poll() is None:
            process.terminate()
            try:
                process.wait(ENDS_WITHIN_S)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        if process.stdout is not None:
            process.stdout.close()
