"""What many submissions cost; prints, and asserts nothing.

    .venv/bin/python tests/bench/batch.py [LAB] [COUNT ...]

For each count: submissions a minute beside the most that the processors allow (colcon and the
nodes alone, measured in the same run), the grader's own CPU, and the memory of one submission.
Nodes are left running for as long as the card says, as `grade` does, which is in the floor; with
`ROSLINGS_SOAK_S=0` in the environment they are not. Each submission differs in a comment, so that
every one is built. `0` in place of a count grades ten that are all the same: what sharing builds
saves.

The floor's builds and the gradings have the same compiled environment: a build that finds a module
to compile keeps the bytecode, which one in a sandbox cannot, so such a floor is refused.
"""

from __future__ import annotations

import os
import platform
import resource
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from statistics import mean

from roslings import course
from roslings.arena import base_environment
from roslings.arena.kernel import cores
from roslings.course.soak import soak_seconds
from roslings.evidence import SoakSeen
from roslings.experiment.run_folder import LOCK, run_folder
from roslings.workspace.build import colcon
from roslings_class.capacity import Capacity
from roslings_class.gradebook import Gradebook, gradebook
from roslings_class.grading import unpacked
from roslings_class.result import GradingResult
from roslings_class.scheduler import BatchProgress, GradingRequest, Scheduler
from roslings_class.submissions import find_submissions

LOOK_EVERY_S = 5.0
ALIKE = 10
BUILDS = 4
"""So often, on each processor, before and after."""
BUILD_EVERY_S = 120.0
"""And so often in between."""


def main(words: list[str]) -> None:
    """Print a line for each count."""
    lab = course.lab(words[0] if words else "topics")
    print(f"{platform.platform()}, Python {platform.python_version()}, {cores()} cores")
    print(
        f"{lab.name:12} {'minutes':>8} {'a minute':>9} {'CPU floor':>10} {'part':>6}"
        f" {'CPU each':>9} {'nodes+build':>12} {'ours':>6}"
        f" {'idle':>5} {'at once':>8} {'MB each':>8} {'unclear':>8}"
    )
    for count in map(int, words[1:] or ["10"]):
        show(count, grade(lab, count))


@dataclass
class Run:
    """One grading of many, and what it took."""

    seconds: float
    cpu_s: float
    floor_s: float
    """CPU seconds of colcon and the nodes alone, for one submission."""
    idle: float
    """Part of the processors that nobody used, others on this machine included."""
    results: list[GradingResult]
    watcher: Watcher


@dataclass
class Watcher:
    """Looks at the memory of all that works; seldom, for one look takes 0.08 s of a processor."""

    most_at_once: int = 0
    peak_each: float = 0.0
    working: int = 0
    cpu_s: float = 0.0
    """Of looking itself, which is no part of grading."""
    _over: threading.Event = field(default_factory=threading.Event)

    def __call__(self, standing: BatchProgress) -> None:
        """What the scheduler tells."""
        self.working = standing.working
        self.most_at_once = max(self.most_at_once, standing.working)

    @contextmanager
    def looking(self) -> Iterator[None]:
        """Look until the block ends."""
        thread = threading.Thread(target=self._look)
        thread.start()
        try:
            yield
        finally:
            self._over.set()
            thread.join()

    def _look(self) -> None:
        while not self._over.wait(LOOK_EVERY_S):
            if self.working:
                self.peak_each = max(self.peak_each, memory_below() / self.working)
        self.cpu_s = time.thread_time()


@dataclass
class Yardstick:
    """CPU seconds of one `colcon build`, with nothing around it, while all processors are busy.

    A machine that others use has slow minutes and quick ones, so it is measured before and after
    the gradings, and now and then between them. These builds count neither as grading nor as floor,
    though the gradings have to wait for them.
    """

    lab: course.Lab
    folder: Path
    each_s: list[float] = field(default_factory=list)

    def measure_alone(self) -> None:
        """Several, one on each processor."""
        compiled = bytecode()
        for _ in range(BUILDS):
            with ThreadPoolExecutor(cores()) as pool:
                self.each_s += pool.map(self._build, range(cores()))
        if new := bytecode() - compiled:
            raise SystemExit(f"The floor's builds have compiled {len(new)} modules. Run it again.")

    @contextmanager
    def measuring(self) -> Iterator[list[float]]:
        """One now and then, until the block ends; the list holds these."""
        over, between_s = threading.Event(), list[float]()
        thread = threading.Thread(target=self._measure_between, args=(over, between_s))
        thread.start()
        try:
            yield between_s
        finally:
            over.set()
            thread.join()
            self.each_s += between_s

    def _measure_between(self, over: threading.Event, between_s: list[float]) -> None:
        while not over.wait(BUILD_EVERY_S):
            between_s.append(self._build())

    def _build(self, _: int = 0) -> float:
        folder = Path(tempfile.mkdtemp(dir=self.folder))
        build = start_build(self.lab, folder)
        _, status, used = os.wait4(build.pid, 0)
        build.returncode = os.waitstatus_to_exitcode(status)
        assert build.returncode == 0
        return used.ru_utime + used.ru_stime


def bytecode() -> set[Path]:
    """All that is compiled of this environment."""
    return set(Path(sys.prefix).rglob("*.pyc"))


def memory_below() -> float:
    """Bytes of all processes that this one started, each page counted once."""
    parents = dict(filter(None, map(parent_of, Path("/proc").glob("[0-9]*"))))
    own = int(Path("/proc/self").resolve().name)
    below = [pid for pid in parents if own in ancestors(pid, parents)]
    return sum(map(share_of, below))


def parent_of(process: Path) -> tuple[int, int] | None:
    """A process and its parent."""
    try:
        words = (process / "stat").read_text().rpartition(")")[2].split()
    except OSError:
        return None
    return int(process.name), int(words[1])


def ancestors(pid: int, parents: dict[int, int]) -> Iterator[int]:
    """The parent, its parent, and so on."""
    while pid := parents.get(pid, 0):
        yield pid


def share_of(pid: int) -> float:
    """Proportional share of memory, in bytes."""
    try:
        lines = Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
    except OSError:
        return 0.0
    return next((int(line.split()[1]) * 1024.0 for line in lines if line.startswith("Pss:")), 0.0)


def grade(lab: course.Lab, count: int) -> Run:
    """Grade `count` different copies of the solution; 0 for ten equal ones."""
    watcher = Watcher()
    with tempfile.TemporaryDirectory() as name:
        yardstick = Yardstick(lab, Path(name))
        yardstick.measure_alone()
        handed_in = hand_in(lab, count, Path(name) / "in")
        with run_folder() as scratch, gradebook(Path(name), lab.name) as book, watcher.looking():
            began_s, began_cpu_s, began_idle_s = time.monotonic(), cpu_s(), idle_s()
            request = GradingRequest(
                lab.name, scratch, scratch / LOCK, soak_s=soak_seconds(lab.card)
            )
            with yardstick.measuring() as between_s:
                Scheduler(request, book, Capacity(), watcher).run(find_submissions(handed_in))
                seconds = time.monotonic() - began_s
                idle = (idle_s() - began_idle_s) / (seconds * cores())
            used_s = cpu_s() - began_cpu_s - sum(between_s)
            results = list(book.latest().values())
            yardstick.measure_alone()
            builds = 1 if count else 1 / ALIKE
            floor_s = builds * mean(yardstick.each_s) + nodes_cpu_s(book, results)
    return Run(seconds, used_s - watcher.cpu_s, floor_s, idle, results, watcher)


def hand_in(lab: course.Lab, count: int, folder: Path) -> Path:
    """So many different copies of the solution; 0 for ten equal ones."""
    for number in range(count or ALIKE):
        package = folder / f"s{number:04}" / lab.card.package
        shutil.copytree(lab.solution, package)
        with (package / "setup.py").open("a") as setup:
            setup.write(f"# {number if count else 0}\n")
    return folder


def idle_s() -> float:
    """Seconds in which this machine's processors had nothing to do, since it was started."""
    words = Path("/proc/stat").read_text("ascii").split()
    return (int(words[4]) + int(words[5])) / os.sysconf("SC_CLK_TCK")


def cpu_s() -> float:
    """CPU seconds of this process and of all that it has waited for."""
    whose = resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN
    return sum(u.ru_utime + u.ru_stime for u in map(resource.getrusage, whose))


def start_build(lab: course.Lab, folder: Path) -> subprocess.Popen[bytes]:
    """Begin a `colcon build` of the solution in a folder of its own."""
    shutil.copytree(lab.solution, folder / "src" / lab.card.package)
    (folder / "home").mkdir()
    quiet = subprocess.DEVNULL
    return subprocess.Popen(
        [colcon(), "build"],
        cwd=folder,
        env=base_environment(folder / "home"),
        stdout=quiet,
        stderr=quiet,
    )


def nodes_cpu_s(book: Gradebook, results: list[GradingResult]) -> float:
    """CPU of the nodes of one submission, as the kernel counted it."""
    kept = [unpacked(content) for result in results if (content := book.evidence(result))]
    whole = sum(
        process.cpu_s
        for evidence in kept
        for seen in (*evidence.experiments.values(), evidence.soak or SoakSeen(for_s=0.0))
        for process in seen.processes.values()
    )
    return whole / max(1, len(kept))


def show(count: int, run: Run) -> None:
    """One line of the table."""
    many = len(run.results)
    a_minute, floor = 60 * many / run.seconds, 60 * cores() / run.floor_s
    each_s = run.cpu_s / many
    unclear = sum(result.word == "inconclusive" for result in run.results)
    print(
        f"{count or f'{ALIKE} alike':<12} {run.seconds / 60:8.2f} {a_minute:9.2f} {floor:10.2f}"
        f" {a_minute / floor:6.0%} {each_s:9.2f} {run.floor_s:12.2f} {each_s - run.floor_s:6.2f}"
        f" {run.idle:5.0%}"
        f" {run.watcher.most_at_once:8} {run.watcher.peak_each / 1e6:8.0f} {unclear:8}",
        flush=True,
    )


if __name__ == "__main__":
    main(sys.argv[1:])
