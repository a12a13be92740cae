"""A message is never said to have come before the one that it answers."""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest

from roslings.probe import raw_subscription, wall_clock
from roslings.probe.wall_clock import to_wall_ns

AHEAD_NS = 1_700_000_000_000_000_000
STOPPED_NS = 3_000_000


@dataclass
class Clocks:
    """Both clocks of a computer that runs others for a while behind some of the looks."""

    stops: list[int] = field(default_factory=list)
    now_ns: int = 0

    def _look(self) -> int:
        self.now_ns += 100 + (self.stops.pop(0) if self.stops else 0)
        return self.now_ns

    def monotonic_ns(self) -> int:
        """From its start."""
        return self._look()

    def time_ns(self) -> int:
        """From 1970."""
        return self._look() + AHEAD_NS


def clocks(monkeypatch: pytest.MonkeyPatch, stops: list[int]) -> Clocks:
    """The only clocks that the probe can read."""
    made = Clocks(stops)
    monkeypatch.setattr(wall_clock, "time", made)
    monkeypatch.setattr(raw_subscription, "time", made)
    return made


@pytest.mark.parametrize("stops", [[0, STOPPED_NS], [0, 0, STOPPED_NS], [STOPPED_NS]])
def test_a_pause_between_two_looks_is_no_difference_of_the_clocks(
    monkeypatch: pytest.MonkeyPatch, stops: list[int]
) -> None:
    """The closest of some pairs counts."""
    clocks(monkeypatch, stops)
    assert abs(to_wall_ns() - AHEAD_NS) <= 100


def test_a_message_comes_when_the_middleware_received_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """However late it is taken, and however long its taker is stopped meanwhile."""
    made = clocks(monkeypatch, [0, STOPPED_NS])
    made.now_ns = 50_000_000
    came_ns = raw_subscription.arrival_ns({"received_timestamp": AHEAD_NS + 40_000_000})
    assert abs(came_ns - 40_000_000) <= 100


def test_a_wall_clock_that_was_set_tells_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """It came now then."""
    made = clocks(monkeypatch, [])
    made.now_ns = 50_000_000
    came_ns = raw_subscription.arrival_ns({"received_timestamp": AHEAD_NS + 10**12})
    assert came_ns > 50_000_000
