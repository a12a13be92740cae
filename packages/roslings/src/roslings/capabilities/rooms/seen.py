"""Sums over a drive: how far from a wall it went, what ground it covered, what stood in its way.

All of it comes from the record alone: the same evidence is judged alike at any time, and without a
room.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from roslings.capabilities.rooms.record import RoomDriveSeen, RoomTick, Side

HULL_M = 0.12
"""The rover is round: from its middle, where the laser is, to its hull."""
CELL_M = 0.25
"""Ground is new where no tick before was in the same cell of this size."""
STANDS_S, STANDS_M = 0.3, 0.01
"""It stands where it has moved no farther than this for so long."""
BESIDE_M = 0.05
"""A thing is in the way that the hull, and so much more, would touch on the way ahead."""
LOOKS_AHEAD_M = 0.6
"""A thing that is farther from the hull is in nobody's way yet."""
PART_95 = 0.95


@dataclass(frozen=True)
class WallDistance:
    """How far from a wall on one side the laser was, from the moment at which it had come to it."""

    from_s: float
    """The moment."""
    count: int
    """Ticks since then."""
    mean_m: float
    p95_m: float
    """95 of 100 ticks were no farther from the wall."""
    mean_off_m: float
    """The mean of how much nearer or farther it was than it should have been."""
    p95_off_m: float
    """In 95 of 100 ticks it was off by no more than this."""


def way_m(drive: RoomDriveSeen) -> float:
    """How long its way was, circles and all."""
    return sum(math.dist(_place(one), _place(two)) for one, two in pairwise(drive.ticks))


def covered_m(drive: RoomDriveSeen, cell_m: float = CELL_M) -> float:
    """How long a way it went over new ground: who drives in circles covers little.

    Ground is new at the first visit of a cell, and a cell counts no more than its own diagonal.
    """
    ways_m: dict[tuple[int, int], float] = {}
    here: tuple[int, int] | None = None
    is_new = False
    for one, two in pairwise(drive.ticks):
        if (cell := _cell(one, cell_m)) != here:
            here, is_new = cell, cell not in ways_m
        if is_new:
            ways_m[cell] = ways_m.get(cell, 0.0) + math.dist(_place(one), _place(two))
    return math.fsum(min(each_m, cell_m * math.sqrt(2)) for each_m in ways_m.values())


def _cell(tick: RoomTick, cell_m: float) -> tuple[int, int]:
    return math.floor(tick.x_m / cell_m), math.floor(tick.y_m / cell_m)


def wall_distance(
    drive: RoomDriveSeen, side: Side, at_m: float, within_m: float
) -> WallDistance | None:
    """How far it was from what stands on a side. None where it never came to a wall there.

    It has come to one where it is first off by no more than `within_m` of `at_m`.
    """
    distances_m = [_beside(tick, side) for tick in drive.ticks]
    near = (n for n, each_m in enumerate(distances_m) if abs(each_m - at_m) <= within_m)
    first = next(near, None)
    if first is None:
        return None
    along_m = distances_m[first:]
    off_m = [abs(each - at_m) for each in along_m]
    return WallDistance(
        from_s=_time_s(drive, first),
        count=len(along_m),
        mean_m=mean(along_m),
        p95_m=quantile(along_m, PART_95),
        mean_off_m=mean(off_m),
        p95_off_m=quantile(off_m, PART_95),
    )


def mean(values: Sequence[float]) -> float:
    """Of at least one value."""
    return math.fsum(values) / len(values)


def quantile(values: Sequence[float], part: float) -> float:
    """The least of the values that this part of them does not exceed; of at least one value."""
    ordered = sorted(values)
    return ordered[max(math.ceil(part * len(ordered)), 1) - 1]


@dataclass(frozen=True)
class Encounter:
    """Something that moves stood, or came, in the way ahead."""

    from_s: float
    to_s: float
    stood_s: float | None
    """When it stood first; None: it never did."""
    stood_m: float | None
    """So far from the thing it stood then."""
    nearest_m: float
    """The least distance from the hull, until the thing was out of the way again."""
    bumped: bool
    """The rover ran into something that moves."""


def encounters(drive: RoomDriveSeen) -> list[Encounter]:
    """Each time that something that moves was in the way, until it was no more."""
    return [_encounter(drive, first, last) for first, last in _stretches(drive)]


def is_in_the_way(tick: RoomTick) -> bool:
    """A thing that moves is ahead, near, and not beside the way."""
    if tick.moving_m is None or tick.moving_ahead_m is None or tick.moving_left_m is None:
        return False
    apart_m = math.hypot(tick.moving_ahead_m, tick.moving_left_m)
    radius_m = apart_m - tick.moving_m - HULL_M
    is_beside = abs(tick.moving_left_m) > HULL_M + BESIDE_M + radius_m
    return tick.moving_ahead_m > 0 and not is_beside and tick.moving_m <= LOOKS_AHEAD_M


def _stretches(drive: RoomDriveSeen) -> Iterator[tuple[int, int]]:
    """First and last tick of each; one that is broken off for a moment is one."""
    first = last = None
    patience = round(1.0 / drive.period_s)
    for number, tick in enumerate(drive.ticks):
        if is_in_the_way(tick):
            first = number if first is None else first
            last = number
        elif first is not None and last is not None and number - last > patience:
            yield first, last
            first = None
    if first is not None and last is not None:
        yield first, last


def _encounter(drive: RoomDriveSeen, first: int, last: int) -> Encounter:
    inside = drive.ticks[first : last + 1]
    from_s, to_s = _time_s(drive, first), _time_s(drive, last)
    stood = next((n for n in range(first, last + 1) if _stands(drive, n)), None)
    hits = (bump for bump in drive.bumps if bump.moving)
    half_s = drive.period_s / 2
    return Encounter(
        from_s=from_s,
        to_s=to_s,
        stood_s=None if stood is None else _time_s(drive, stood),
        stood_m=None if stood is None else drive.ticks[stood].moving_m,
        nearest_m=min(tick.moving_m for tick in inside if tick.moving_m is not None),
        bumped=any(from_s - half_s <= bump.time_s <= to_s + half_s for bump in hits),
    )


def _stands(drive: RoomDriveSeen, number: int) -> bool:
    """At a tick, and for a while before it."""
    ticks = round(STANDS_S / drive.period_s)
    before = drive.ticks[max(number - ticks, 0)]
    return number >= ticks and math.dist(_place(before), _place(drive.ticks[number])) <= STANDS_M


def said_anything(drive: RoomDriveSeen) -> bool:
    """Some command moved the rover, or should have."""
    return any(tick.forward_m_s or tick.turn_rad_s for tick in drive.ticks)


def _time_s(drive: RoomDriveSeen, number: int) -> float:
    """Robot time since the start, when this tick was over."""
    return round((number + 1) * drive.period_s, 6)


def _beside(tick: RoomTick, side: Side) -> float:
    return tick.left_m if side == "left" else tick.right_m


def _place(tick: RoomTick) -> tuple[float, float]:
    return tick.x_m, tick.y_m
