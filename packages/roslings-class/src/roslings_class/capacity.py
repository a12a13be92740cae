"""How many gradings at once: measured, because a part of a grading is waiting.

It begins with one for each core: the experiments of a grading run side by side, and keep a core
busy. While the processors have time to spare and there is memory for one more, one more is let in.
When nothing is left to spare, it is one fewer, down to one for each core.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from roslings.arena.kernel import cores

SPARE, BUSY = 0.03, 0.005
"""Idle part of the processors above which one more is let in, and below which one fewer."""
LOOK_EVERY_S = 3.0
NEWEST = 0.3
"""What the newest look weighs in the mean. Those that build at the same time wait at the same time.
So one look often sees only the one or only the other."""
MOST_PER_CORE = 2
MOST_SOAKING_PER_CORE = 16
"""Those whose nodes only run on: half a minute of it fills this with gradings of two seconds."""
NEEDS_BYTES = 500_000_000
"""Memory that one grading may come to need: grader, probe, colcon and nodes."""


@dataclass(frozen=True)
class MachineLoad:
    """The machine at one moment."""

    at_s: float
    idle_s: float
    """Since it was started, over all processors."""
    free_bytes: int


def look() -> MachineLoad:
    """Look at this machine."""
    return MachineLoad(time.monotonic(), _idle_s(), _free_bytes())


def _idle_s() -> float:
    words = Path("/proc/stat").read_text("ascii").splitlines()[0].split()
    return (int(words[4]) + int(words[5])) / os.sysconf("SC_CLK_TCK")


def _free_bytes() -> int:
    for line in Path("/proc/meminfo").read_text("ascii").splitlines():
        if line.startswith("MemAvailable:"):
            return int(line.split()[1]) * 1024
    return os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


@dataclass
class Capacity:
    """How many may work at once, by what was seen of the machine so far."""

    fixed: int | None = None
    """What `--jobs` says; then nothing is measured but the memory."""
    alone: bool = False
    """Whether one that only waits, while its nodes run on, keeps its place."""
    cores: int = field(default_factory=cores)
    look: Callable[[], MachineLoad] = look
    allowed: int = 0
    _last: MachineLoad | None = None
    _idle: float | None = None
    """The idle part of the processors: a mean in which older looks weigh less and less."""

    def __post_init__(self) -> None:
        self.allowed = self.fixed or self.cores

    def now(self, working: int, soaking: int = 0) -> int:
        """How many there may be now, of `working` that are there already; at least one.

        Of these, `soaking` only wait until their nodes have run for long enough. They cost
        memory, and next to nothing else.
        """
        if self.alone or (self.fixed and not soaking):
            return self.fixed or 1
        if soaking >= MOST_SOAKING_PER_CORE * self.cores:
            return working
        seen = self.look()
        busy = self.fixed or self._busy(working - soaking, seen)
        return max(1, min(busy + soaking, working + seen.free_bytes // NEEDS_BYTES))

    def _busy(self, working: int, seen: MachineLoad) -> int:
        """How many may compute now, of whom `working` do already."""
        if self._last is None:
            self._last = seen
        elif seen.at_s - self._last.at_s >= LOOK_EVERY_S:
            self._adjust(self._mean_with(self._idle_part(seen)), working)
            self._last = seen
        return self.allowed

    def _idle_part(self, seen: MachineLoad) -> float:
        assert self._last is not None
        passed_s = seen.at_s - self._last.at_s
        return (seen.idle_s - self._last.idle_s) / (passed_s * (os.cpu_count() or 1))

    def _mean_with(self, idle: float) -> float:
        mean = idle if self._idle is None else (1 - NEWEST) * self._idle + NEWEST * idle
        self._idle = mean
        return mean

    def _adjust(self, idle: float, working: int) -> None:
        if idle > SPARE and working >= self.allowed:
            self.allowed = min(self.allowed + 1, MOST_PER_CORE * self.cores)
        elif idle < BUSY:
            self.allowed = max(self.allowed - 1, self.cores)
