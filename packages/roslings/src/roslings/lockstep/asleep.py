"""Who sleeps on the wall clock: `time.sleep` in a loop does not follow /clock, and is named.

A thread that sleeps stands in a system call of its own. `Rate` and `Event.wait` stand in futex,
as the middleware's threads always do: nobody can tell these apart, so they are never named.
"""

from __future__ import annotations

import platform
from collections import Counter
from dataclasses import dataclass, field
from typing import Literal

from roslings.lockstep.quiet import Stat, Thread, ThreadAccount

Stands = Literal["sleeps", "waits with a time-out", "elsewhere", "unknown"]
SLEEPS: dict[str, frozenset[int]] = {
    "x86_64": frozenset({35, 230}),
    "aarch64": frozenset({101, 115}),
}
"""nanosleep and clock_nanosleep (`hrtimer_nanosleep` in the kernel): `time.sleep` from 3.11 on."""
SELECTS: dict[str, frozenset[int]] = {
    "x86_64": frozenset({23, 270}),
    "aarch64": frozenset({72}),
}
"""select and pselect6: `time.sleep` of Python 3.10 waits for no file, with a time-out."""
FUTEX: dict[str, int] = {"x86_64": 202, "aarch64": 98}
SLEEPS_IN = ("hrtimer_nanosleep", "common_nsleep", "do_nanosleep")
"""The same in the words of wchan."""
MACHINE = platform.machine()
NAMED_FROM_TICKS = 2
"""A single one may be a start that is not over yet."""


@dataclass(frozen=True)
class SystemCall:
    """What /proc/PID/task/TID/syscall tells: where a thread stands in the kernel."""

    number: int
    arguments: tuple[int, ...]

    @classmethod
    def of(cls, text: str) -> SystemCall | None:
        """None where the thread runs, or is in no system call."""
        words = text.split()
        if len(words) < 7 or not words[0].isdigit():
            return None
        return cls(int(words[0]), tuple(int(word, 16) for word in words[1:7]))

    def stands(self, machine: str) -> Stands:
        """On a machine of this kind."""
        if machine not in FUTEX:
            return "unknown"
        waits_for_no_file = self.number in SELECTS[machine] and self.arguments[0] == 0
        if self.number in SLEEPS[machine] or waits_for_no_file:
            return "sleeps"
        if self.number == FUTEX[machine] and self.arguments[3]:
            return "waits with a time-out"
        return "elsewhere"


def stands_in(thread: Thread, machine: str = MACHINE) -> Stands:
    """Where a thread stands. Some kernels (Yama) tell the call only to whoever began the process,
    and the function to all of the same user."""
    try:
        call = SystemCall.of(thread.read("syscall").decode())
        return call.stands(machine) if call else "elsewhere"
    except PermissionError:
        return by_function(thread)
    except OSError:
        return "elsewhere"


def by_function(thread: Thread) -> Stands:
    """The same by the kernel's function in which it stands."""
    try:
        function = thread.read("wchan").decode().strip()
    except OSError:
        return "unknown"
    if function in ("", "0"):
        return "unknown"
    return "sleeps" if function in SLEEPS_IN else "elsewhere"


@dataclass(frozen=True)
class Sleeper:
    """A thread that was seen asleep on the wall clock."""

    pid: int
    thread: str
    """Its name; empty for the main thread."""
    ticks: int
    """In so many ticks."""

    @property
    def words(self) -> str:
        """For whoever wrote it."""
        which = f"its thread {self.thread}" if self.thread else "its main thread"
        return (
            f"A loop of your node ({which}, process {self.pid}) sleeps on the wall clock: "
            "it stood in time.sleep, or in what calls it, while robot time went on. "
            "It is judged in real time; a timer would follow /clock."
        )


@dataclass
class Watch:
    """Counts who sleeps, tick by tick."""

    account: ThreadAccount
    _seen: Counter[tuple[int, int]] = field(default_factory=Counter)

    def look(self) -> None:
        """At one moment of quiet."""
        for pid, thread in self.account.threads_of_nodes():
            if stands_in(thread) == "sleeps":
                self._seen[pid, thread.number] += 1

    @property
    def sleepers(self) -> tuple[Sleeper, ...]:
        """Those that slept again and again, in the order in which they were seen."""
        return tuple(
            Sleeper(pid, self._name(pid, thread), ticks)
            for (pid, thread), ticks in self._seen.items()
            if ticks >= NAMED_FROM_TICKS
        )

    def _name(self, pid: int, thread: int) -> str:
        if pid == thread:
            return ""
        try:
            file = self.account.proc / str(pid) / "task" / str(thread) / "stat"
            return Stat.of(file.read_bytes()).name
        except OSError:
            return str(thread)
