"""What a bag holds, reckoned from its messages: the truth about it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from statistics import median

from roslings_rover.models.drives.recording import NS, RecordedMessage, of_topic

SHORTEST_PAUSE = 1.5
"""In usual periods: what is shorter is no pause, whatever anybody calls a gap."""
SPEED, X, Y = 0, 2, 3
"""Where these stand in the values of odometry."""


@dataclass(frozen=True)
class Pause:
    """A time between two messages of a topic in a row that is longer than usual."""

    topic: str
    seconds: float
    start_s: float
    periods: float


def usual_period_s(times_ns: Sequence[int]) -> float | None:
    """The median of the times between two in a row; None for less than two."""
    between = [later - earlier for earlier, later in pairwise(times_ns)]
    return median(between) / NS if between else None


def pauses_of(topic: str, said: Sequence[RecordedMessage]) -> Iterable[Pause]:
    """The pauses of one topic."""
    times = [each.time_ns for each in of_topic(said, topic)]
    usual_s = usual_period_s(times)
    for earlier, later in pairwise(times):
        seconds = (later - earlier) / NS
        if usual_s and seconds / usual_s > SHORTEST_PAUSE:
            start_s = (earlier - said[0].time_ns) / NS
            yield Pause(topic, seconds, start_s, seconds / usual_s)


def duration_s(said: Sequence[RecordedMessage]) -> float:
    """From the first message to the last one."""
    return (said[-1].time_ns - said[0].time_ns) / NS


def distance_m(odometry: Sequence[RecordedMessage]) -> float:
    """The length of the way through all positions."""
    steps = pairwise(odometry)
    return sum(math.hypot(b.values[X] - a.values[X], b.values[Y] - a.values[Y]) for a, b in steps)


def top_speed_m_s(odometry: Sequence[RecordedMessage]) -> float:
    """The largest speed, forward or backward."""
    return max(abs(each.values[SPEED]) for each in odometry)
