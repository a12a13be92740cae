"""The time in the bag: it runs with a rate, and can be stopped."""

from __future__ import annotations

import time

STEP = 0.1
"""A key makes it so much quicker or slower."""


class BagClock:
    """Tells which moment of the bag is now, in nanoseconds since 1970."""

    def __init__(self, begin_ns: int, rate: float, paused: bool) -> None:
        self.rate, self.paused = rate, paused
        self.set(begin_ns)

    def set(self, time_ns: int) -> None:
        """From now on it is `time_ns`."""
        self._from_ns, self._from_s = time_ns, time.monotonic()

    def now_ns(self) -> int:
        """The moment in the bag."""
        if self.paused:
            return self._from_ns
        return self._from_ns + round((time.monotonic() - self._from_s) * 1e9 * self.rate)

    def left_s(self, time_ns: int) -> float:
        """How long until it is `time_ns`, in real seconds; endless while it stands."""
        if self.paused:
            return float("inf")
        return (time_ns - self.now_ns()) / 1e9 / self.rate

    def pause(self, paused: bool) -> None:
        """Stop, or go on."""
        self.set(self.now_ns())
        self.paused = paused

    def hurry(self, rate: float) -> None:
        """Another rate."""
        self.set(self.now_ns())
        self.rate = rate
