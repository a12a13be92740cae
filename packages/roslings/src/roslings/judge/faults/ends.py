"""How a process ended: a part of many sentences."""

from __future__ import annotations

import signal
from dataclasses import dataclass

from roslings.judge.faults.sentences import SentencePart, one_of, some_of


@dataclass(frozen=True)
class End(SentencePart):
    """How a process ended: `exit code 1`, or `ended by SIGSEGV`, and which bounds it met."""

    status: int | None
    bounds: tuple[str, ...] = ()
    """Of its sandbox."""

    text = some_of(
        between="; ",
        code="exit code {status}",
        signal="ended by {signal}",
        unknown="status unknown",
        memory="it took more memory than it may",
        files="it made more files than it may",
        output="it printed without end",
        pids="it started more processes and threads than it may",
        cpu_s="its processes took more time of the processor than they may",
    )

    @property
    def which_text(self) -> tuple[str, ...]:
        """The status, then each bound."""
        if self.status is None:
            return "unknown", *self.bounds
        return "signal" if self.status < 0 else "code", *self.bounds

    @property
    def signal(self) -> str:
        """The signal that ended it; empty where none did."""
        return signal.Signals(-self.status).name if self.status and self.status < 0 else ""

    @property
    def is_bad(self) -> bool:
        """Neither exit code 0 nor unknown."""
        return bool(self.status)


@dataclass(frozen=True)
class Went(SentencePart):
    """Of a program that has one task: whether it ended, and how."""

    end: End | None
    """None: it ran on."""
    text = one_of(ended="the program ended ({end})", ran_on="the program ran on")

    @property
    def which_text(self) -> str:
        """Whether it ended."""
        return "ended" if self.end else "ran_on"
