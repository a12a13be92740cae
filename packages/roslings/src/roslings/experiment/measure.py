"""Called in the command's process: have a package measured behind the machine's best wall."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from ros2_on_pip.errors import INCONCLUSIVE, RoslingsError
from roslings.arena import Isolation, choose_isolation, isolation_for_strangers
from roslings.course.grader import Clock
from roslings.evidence import Evidence, PackageSeen
from roslings.experiment.assignment import Assignment
from roslings.experiment.forked import Fork
from roslings.experiment.run_folder import run_folder
from roslings.experiment.walls import closed_places
from roslings.workspace.errors import DiskFull
from roslings.workspace.student import stage

ENDS_WITHIN_S = 30.0
LAST_WORDS = 20
ROOM_NEEDED_BYTES = 1024 * 1024


class MeasuringFailed(RoslingsError):
    """The measuring process itself ended without evidence: the machine's fault, or ours."""

    exit_status = INCONCLUSIVE

    def __init__(self, status: int, words: str) -> None:
        """`words` are all that it wrote; the message has the last of them."""
        self.status, self.words = status, words
        last = "\n".join(words.splitlines()[-LAST_WORDS:])
        super().__init__(f"The measurement broke off (status {status}).\n{last}".rstrip())


@dataclass(frozen=True)
class MeasuringOptions:
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
    builds_from_cache: bool = False
    """Whether those that differ in their modules alone do, too: for a lab's own packages."""
    strangers: bool = False
    """Whether somebody else's package is graded: then the wall for strangers' code is taken."""
    for_others: bool = False
    """Whether somebody else believes the result, trusted package or not."""
    soak_s: float = 0.0
    """How long the nodes run among themselves, beside the experiments; 0: not at all."""
    only_soak: bool = False
    """Whether nothing else is made."""


class MeasuringProcess:
    """A measuring process that has begun, and waits for the package that it is to measure."""

    def __init__(self, assignment: Assignment, walls: Isolation, process: Fork) -> None:
        self._order, self._walls, self._process = assignment, walls, process

    def measure(
        self,
        package: Path,
        seen: PackageSeen,
        on_step: Callable[[str], None],
        meanwhile: Callable[[], object] = lambda: None,
    ) -> Evidence:
        """Build and run the package at `package`; `on_step` is told what happens.

        `meanwhile` is called while colcon builds. Raises MeasuringFailed, DiskFull, and whatever
        staging a copy of the package raises.
        """
        stage(package, self._order.source_of(seen))
        self._process.tell(seen.model_dump_json())
        meanwhile()
        self._follow(on_step)
        evidence = Evidence.model_validate_json(self._order.evidence.read_bytes())
        if self._walls.because:
            because = f"Measured without a network of its own: {self._walls.because}."
            evidence.advice.append(because)
        return evidence

    def _follow(self, on_step: Callable[[str], None]) -> None:
        for line in self._process.stdout:
            on_step(line.rstrip())
        if status := self._process.wait():
            if shutil.disk_usage(self._order.folder).free < ROOM_NEEDED_BYTES:
                raise DiskFull(self._order.folder)
            raise MeasuringFailed(status, self._order.errors.read_text("utf-8", errors="replace"))


@contextmanager
def measuring_process(lab: str, choices: MeasuringOptions) -> Iterator[MeasuringProcess]:
    """A measuring process behind the machine's best wall; it ends with the block.

    It is a fork: begin before this process has threads.
    """
    walls = isolation_for_strangers() if choices.strangers else choose_isolation()
    with run_folder() as folder, walls.user() as leased:
        user = replace(leased, closed=closed_places()) if leased and not walls.leases else None
        assignment = Assignment(
            lab=lab,
            seed=choices.seed,
            wall=walls.wall,
            sandbox=walls.sandbox_of(leased),
            clock=choices.clock,
            folder=folder,
            keeps_bags=choices.bags is not None,
            port=choices.port,
            hidden=choices.hidden,
            user=user,
            builds=None if user else choices.builds,
            builds_from_cache=choices.builds_from_cache,
            for_others=choices.for_others,
            only_soak=choices.only_soak,
            soak_s=0.0 if choices.port else choices.soak_s,
        )
        assignment.make_folders()
        with assignment.errors.open("wb") as errors:
            fork = Fork(assignment, walls, errors.fileno())
        with _ended(fork) as process:
            yield MeasuringProcess(assignment, walls, process)
        if choices.bags is not None and assignment.bags.is_dir():
            shutil.copytree(assignment.bags, choices.bags)


def measure(
    lab: str,
    package: Path,
    seen: PackageSeen,
    choices: MeasuringOptions,
    on_step: Callable[[str], None],
) -> Evidence:
    """Begin to measure, and measure the package at `package`, as `MeasuringProcess` does."""
    with measuring_process(lab, choices) as begun:
        return begun.measure(package, seen, on_step)


@contextmanager
def _ended(process: Fork) -> Iterator[Fork]:
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
        process.close()
