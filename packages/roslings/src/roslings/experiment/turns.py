"""Start-ups and timed stretches of several experiments take turns.

A node that starts takes a processor for half a second. Where another node's answers are timed
meanwhile, that could make them late; so the two never happen at once.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

from roslings.probe.probe import CalledOff


class Turns:
    """Any number of experiments may be busy at once, and any number timed, but never both.

    Who wants to be busy goes first: all nodes come up, then all timed stretches run side by side.
    Within a turn of its own, a thread needs no other.
    """

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._busy = self._timed = 0
        self._coming = 0
        """Those who wait to be busy."""
        self._own = threading.local()
        self._called_off = False

    def busy(self) -> AbstractContextManager[None]:
        """A stretch that takes processors, such as the start of a node. Raises CalledOff."""
        return self._turn(self._begin_busy, self._end_busy)

    def timed(self) -> AbstractContextManager[None]:
        """A stretch in which times are judged. Raises CalledOff."""
        return self._turn(self._begin_timed, self._end_timed)

    def call_off(self) -> None:
        """End the waiting of all threads: they raise CalledOff."""
        with self._changed:
            self._called_off = True
            self._changed.notify_all()

    @contextmanager
    def _turn(self, begin: Callable[[], None], end: Callable[[], None]) -> Iterator[None]:
        if getattr(self._own, "turn", False):
            yield
            return
        with self._changed:
            begin()
        self._own.turn = True
        try:
            yield
        finally:
            self._own.turn = False
            with self._changed:
                end()
                self._changed.notify_all()

    def _begin_busy(self) -> None:
        self._coming += 1
        try:
            self._wait(lambda: not self._timed)
        finally:
            self._coming -= 1
            self._changed.notify_all()
        self._busy += 1

    def _end_busy(self) -> None:
        self._busy -= 1

    def _begin_timed(self) -> None:
        self._wait(lambda: not self._busy and not self._coming)
        self._timed += 1

    def _end_timed(self) -> None:
        self._timed -= 1

    def _wait(self, condition: Callable[[], bool]) -> None:
        self._changed.wait_for(lambda: condition() or self._called_off)
        if self._called_off:
            raise CalledOff
