"""The kernel's account of some processes: whether anything in them runs, or has run.

A set of processes is quiet when two looks in a row find each thread asleep (state S), and none has
had a time slice in between. A message that was sent wakes its receiver at once, so whoever looks
after that finds it at work, and quiet means: it has done all that the message led to.
"""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

PROC = Path("/proc")
CAP_S = 10.0
"""rclpy's MultiThreadedExecutor may submit one waiting task again and again for 2 s of its own."""
PAUSE_S = 0.0001
"""Between two looks: whoever looks without a pause takes the processor that the nodes need."""
RESTS = frozenset("SZX")
"""States of a thread that does nothing: asleep, or at its end."""

Slices = dict[int, int]
"""How often each thread has got a processor, by its number."""


class NoAccount(Exception):
    """The kernel tells nothing here: take real time instead, and say so."""

    def __init__(self, lack: str) -> None:
        super().__init__(
            f"The nodes cannot be watched step by step here: {lack}. They are judged in real time."
        )


class Gone(Exception):
    """A process ended while the world was with it."""

    def __init__(self, pid: int) -> None:
        self.pid = pid
        super().__init__(f"The process {pid} has ended.")


class NeverQuiet(Exception):
    """Something ran on and on: no time can pass in lockstep with it."""

    def __init__(self, waited_s: float, busy: Sequence[str]) -> None:
        self.busy = tuple(busy)
        """The threads that ran at the last look, by their names."""
        who = ", ".join(busy) or "a thread"
        super().__init__(
            f"After {waited_s:.1f} s something still runs in your nodes: {who}. "
            "Look for a loop that never waits, such as `while` with `spin_once(timeout_sec=0)`."
        )


@dataclass(frozen=True)
class Stat:
    """What /proc/PID/task/TID/stat tells of a thread."""

    name: str
    state: str

    @classmethod
    def of(cls, text: str) -> Stat:
        """The name may hold anything, brackets and blanks too: the last bracket ends it."""
        before, _, after = text.rpartition(")")
        return cls(before.partition("(")[2], after.split()[0])


def slices_of(text: str) -> int:
    """The third number of schedstat: how often the thread has got a processor."""
    return int(text.split()[2])


@dataclass(frozen=True)
class Look:
    """All threads at one moment."""

    slices: Slices
    busy: tuple[str, ...]
    """Names of those that do not rest."""


@dataclass
class Account:
    """Of these processes and all their children; of our own other threads, too, with `ours`."""

    pids: Sequence[int]
    proc: Path = PROC
    ours: bool = True
    """The threads of the middleware in this process take part in what is said, too."""
    _family: list[int] = field(default_factory=list)

    def check(self) -> None:
        """Raises NoAccount where the kernel tells nothing of them, and Gone where one has ended."""
        if not (self.proc / "self" / "stat").exists():
            raise NoAccount(f"there is no {self.proc}")
        for pid in self.pids:
            if not _lives(pid):
                raise Gone(pid)
            if not (self.proc / str(pid) / "stat").exists():
                raise NoAccount(f"{self.proc} hides other processes (hidepid)")
        slices = self.look().slices
        if not all(slices.get(pid) for pid in self.pids):
            raise NoAccount("the kernel counts no time slices (schedstat)")

    def look(self) -> Look:
        """Once, at all threads."""
        if not self._family:
            self._family = list(self._now_alive())
        slices: Slices = {}
        busy: list[str] = []
        for thread in self._threads():
            seen = self._seen(thread)
            if seen is None:  # it has ended since it was listed: that is a change, too
                busy.append(f"thread {thread.name}")
                continue
            stat, count = seen
            slices[int(thread.name)] = count
            if stat.state not in RESTS:
                busy.append(stat.name)
        return Look(slices, tuple(busy))

    def threads_of_nodes(self) -> Iterator[Path]:
        """The folder of each thread, ours left out."""
        for pid in self._family:
            try:
                yield from _folders(self.proc / str(pid) / "task")
            except OSError:
                continue

    def is_quiet_within(self, within_s: float) -> bool:
        """Wait for quiet, so long at most. Raises Gone where one of the processes has ended."""
        ends_s = time.monotonic() + within_s
        self._family = list(self._now_alive())
        last: Look | None = None
        while True:
            now = self.look()
            if not now.busy and last is not None and now.slices == last.slices:
                if (alive := list(self._now_alive())) == self._family:
                    return True
                self._family = alive  # a child was born meanwhile: look at it, too
            if time.monotonic() >= ends_s:
                return False
            last = now
            time.sleep(PAUSE_S)

    def busy_names(self) -> tuple[str, ...]:
        """Who runs now."""
        return self.look().busy

    def _threads(self) -> Iterator[Path]:
        yield from self.threads_of_nodes()
        if self.ours:
            me = str(threading.get_native_id())
            own = _folders(self.proc / str(os.getpid()) / "task")
            yield from (each for each in own if each.name != me)

    def _seen(self, thread: Path) -> tuple[Stat, int] | None:
        try:
            stat = Stat.of(_text(thread / "stat"))
            return stat, slices_of(_text(thread / "schedstat"))
        except (FileNotFoundError, ProcessLookupError):
            return None

    def _now_alive(self) -> Iterator[int]:
        """The processes and their children, the oldest first."""
        for pid in self.pids:
            if not self._runs(pid):
                raise Gone(pid)
            yield from self._with_children(pid)

    def _runs(self, pid: int) -> bool:
        seen = self._seen(self.proc / str(pid))
        return seen is not None and seen[0].state not in "ZX"

    def _with_children(self, pid: int) -> Iterator[int]:
        yield pid
        for child in self._children(pid):
            yield from self._with_children(child)

    def _children(self, pid: int) -> list[int]:
        """A kernel without CONFIG_PROC_CHILDREN tells none: launch files need their nodes' ids."""
        found: list[int] = []
        try:
            for thread in _folders(self.proc / str(pid) / "task"):
                found += map(int, _text(thread / "children").split())
        except (FileNotFoundError, ProcessLookupError):
            return found
        return found


def _folders(task: Path) -> list[Path]:
    return [task / name for name in os.listdir(task)]  # noqa: PTH208 - thrice as quick


def _text(file: Path) -> str:
    with open(file) as opened:  # noqa: PTH123 - the same
        return opened.read()


def _lives(pid: int) -> bool:
    """Whether there is such a process, whatever /proc shows of it."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True
