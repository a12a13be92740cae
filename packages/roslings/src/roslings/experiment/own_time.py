"""Time as the student's processes had it: without what they waited for a processor."""

from __future__ import annotations

import time
from collections.abc import Sequence

from ros2_on_pip.rates import NS_PER_S
from roslings.arena import LONGEST_WAIT_S, Arena, Process
from roslings.experiment.on_the_wall import longest_wait_s

PATIENCE_S = LONGEST_WAIT_S
"""Who waits longer than this for a processor is not waited for, and not judged."""


class OwnTime:
    """Time since a moment, of all processes of an arena."""

    def __init__(self, arena: Arena) -> None:
        """From now on."""
        self._arena = arena
        self._began_s = time.monotonic()
        self._before = {process: process.waits_ns() for process in arena.processes}
        self._devices_before = arena.devices_waits_ns()
        self._asking_s = time.monotonic() - self._began_s
        """On a busy computer the account comes seconds late, and holds what was waited then."""
        self._most_waited_s = 0.0
        """The most that was told so far: of a process that is about to go, nothing is told."""

    def is_past(self, limit_s: float) -> bool:
        """So much of it has passed. The kernel is asked where it matters."""
        beyond_s = time.monotonic() - self._began_s - limit_s
        return beyond_s > 0 and beyond_s > min(self.waited_s(), PATIENCE_S)

    def waited_s(self) -> float:
        """The longest time that one of their threads was ready, and no processor was free.

        A node waits for its board or its camera, too: what those waited comes on top.
        """
        told_s = waited_s(self._arena.processes, self._before) + self._devices_waited_s()
        self._most_waited_s = max(self._most_waited_s, told_s)
        return self._most_waited_s + self._asking_s

    def _devices_waited_s(self) -> float:
        now_ns = self._arena.devices_waits_ns()
        return longest_wait_s(self._devices_before, now_ns) if now_ns else 0.0

    def waited_in_turn_s(self) -> float:
        """What all of their threads waited, added up.

        An answer goes through several, one after the other: who receives, who decides, who works.
        """
        return (
            sum(
                max(0, now_ns - self._before.get(process, {}).get(thread, 0))
                for process in self._arena.processes
                for thread, now_ns in _waits_ns(process).items()
            )
            / NS_PER_S
        )


def waited_s(processes: Sequence[Process], before: dict[Process, dict[str, int]]) -> float:
    """The longest that one thread of these waited for a processor, since `before`.

    What has ended meanwhile counts as it was when it ended, where that is known.
    """
    return max((_waited_s(each, before.get(each, {})) for each in processes), default=0.0)


def _waited_s(process: Process, before_ns: dict[str, int]) -> float:
    now_ns = _waits_ns(process)
    return longest_wait_s(before_ns, now_ns) if now_ns else 0.0


def _waits_ns(process: Process) -> dict[str, int]:
    """Thread to what it has waited; empty where the kernel tells nothing."""
    return process.waits_ns() if process.alive else process.last_waits_ns
