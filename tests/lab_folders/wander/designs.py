"""Two other ways to do the lab wander: nobody needs the solution's rule to have all points.

Each is a rule that gives forward (m/s) and turn (rad/s) for a scan, wherever the wall is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Protocol

from sensor_msgs.msg import LaserScan

WALL_AT_M = 0.4
STOPS_AT_M = 0.42
FASTEST_M_S, FASTEST_RAD_S = 0.2, 1.5
WAITS_S = 3.0
"""Something has moved: so long it stands."""
MOVED_M = 0.02
FREE_M = 4.0
FAR_M = 1.2
"""A wall that is farther away is followed by nobody."""
Seen = dict[int, float]
"""Whole degrees to metres; 90 is beside the wall."""


class Rule(Protocol):
    """Says what to do now."""

    def __call__(self, seen: Seen) -> tuple[float, float]:
        """Forward, and a turn that is positive towards the wall."""


def by_degrees(scan: LaserScan, sign: int) -> Seen:
    """What is near in each direction; nothing at all is far away."""
    seen = dict.fromkeys(range(-180, 180), FREE_M)
    for number, distance_m in enumerate(scan.ranges):
        angle = sign * (scan.angle_min + number * scan.angle_increment)
        degrees = round(math.degrees(angle) + 180) % 360 - 180
        if not math.isnan(distance_m):
            seen[degrees] = min(seen[degrees], max(distance_m, 0.0))
    return seen


def nearest(seen: Seen, first: int, last: int) -> float:
    """Between two directions."""
    return min(seen[degrees] for degrees in range(first, last + 1))


def bang_bang(seen: Seen) -> tuple[float, float]:
    """It knows three turns: to the wall, away from it, and none."""
    where = min(range(30, 151), key=lambda degrees: seen[degrees])
    if seen[where] > FAR_M:
        return FASTEST_M_S, 0.0
    off_m = seen[where] - WALL_AT_M
    aim = where - 90 + max(-45.0, min(45.0, 120 * off_m))
    if abs(aim) < 6:
        return FASTEST_M_S, 0.0
    return FASTEST_M_S * 0.5, math.copysign(0.6, aim)


def vector_field(seen: Seen) -> tuple[float, float]:
    """It drives along a vector: one part along the wall, one part towards its distance."""
    where = min(range(20, 161), key=lambda degrees: seen[degrees])
    if seen[where] > FAR_M:
        return FASTEST_M_S, 0.0
    beside = math.radians(where)
    pull = max(-1.5, min(1.5, 3.0 * (seen[where] - WALL_AT_M)))
    along, across = math.sin(beside), -math.cos(beside)
    x = along + pull * math.cos(beside)
    y = across + pull * math.sin(beside)
    heading = math.atan2(y, x)
    turn = max(-FASTEST_RAD_S, min(FASTEST_RAD_S, 1.8 * heading))
    return FASTEST_M_S * max(0.2, math.cos(heading)), turn


@dataclass
class Waiting:
    """A rule, behind one that stands before what is ahead, and waits while that moves."""

    rule: Rule
    side: str
    stands: bool = False
    goes_at_s: float = 0.0
    ahead_m: float = field(default=FREE_M)

    def __call__(self, scan: LaserScan) -> tuple[float, float]:
        """Forward, and a turn that is positive to the left."""
        sign = 1 if self.side == "left" else -1
        now_s = scan.header.stamp.sec + scan.header.stamp.nanosec / 1e9
        forward, turn = self._decided(by_degrees(scan, sign), now_s)
        return forward, sign * turn

    def _decided(self, seen: Seen, now_s: float) -> tuple[float, float]:
        ahead_m = nearest(seen, -25, 25)
        if ahead_m >= STOPS_AT_M and nearest(seen, -60, 60) >= 0.22:
            self.stands = False
            forward, turn = self.rule(seen)
            return min(forward, max(0.05, ahead_m - STOPS_AT_M)), turn
        if not self.stands:
            self.stands, self.goes_at_s = True, now_s + 0.5
        elif now_s < self.goes_at_s and abs(ahead_m - self.ahead_m) > MOVED_M:
            self.goes_at_s = now_s + WAITS_S
        self.ahead_m = ahead_m
        return 0.0, -0.75 if now_s >= self.goes_at_s else 0.0
