"""Time as a script had it: without what its programs worked, and what they waited to work.

A script runs one program after the other. Each loads, for a second on a fast computer and for four
on a slow one. And each waits for a processor in its turn, so what they waited is added up. A node's
threads wait at the same time, so there the longest wait counts.
"""

from __future__ import annotations

import time

from ros2_on_pip.rates import NS_PER_S
from roslings.arena import LONGEST_WAIT_S, Arena, Process

LOADS_WITHIN_S = 8.0
"""Of work; who works on for longer is not loading any more."""
LONGEST_S = LOADS_WITHIN_S + LONGEST_WAIT_S
"""So much longer than by its own time it may take by the wall's clock."""


class ScriptTime:
    """Since it was made, of one script and all that runs beside it."""

    def __init__(self, arena: Arena, script: Process) -> None:
        """From now on."""
        self._arena, self._script = arena, script
        self._worked_before_s = script.worked_s()
        self._waits_ns: dict[tuple[Process, str], int] = {}
        """Of each thread the most that was told: an ended one is not forgotten."""
        self._note_waits()
        self._before_ns = sum(self._waits_ns.values())
        self._began_s = time.monotonic()
        """When all had told: on a busy computer the first answer comes seconds late."""

    def is_past(self, limit_s: float) -> bool:
        """So much of it has passed. Ask often: of what ends in between, no wait is known."""
        self._note_waits()
        beyond_s = time.monotonic() - self._began_s - limit_s
        return beyond_s > 0 and beyond_s > self._loaded_s() + self._waited_s()

    def _note_waits(self) -> None:
        for process in self._arena.processes:
            for thread, waited_ns in process.waits_ns().items():
                known_ns = self._waits_ns.get((process, thread), 0)
                self._waits_ns[process, thread] = max(known_ns, waited_ns)

    def _waited_s(self) -> float:
        waited_ns = sum(self._waits_ns.values()) - self._before_ns
        return min(waited_ns / NS_PER_S, LONGEST_WAIT_S)

    def _loaded_s(self) -> float:
        worked_s = self._script.worked_s() - self._worked_before_s  # below 0 when it is gone
        return min(max(0.0, worked_s), LOADS_WITHIN_S)
