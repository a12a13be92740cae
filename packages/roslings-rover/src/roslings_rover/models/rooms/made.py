"""Makes the room of a seed: the same one on every computer, and in every version of Python."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

from roslings_rover.models.drives.chance import Chance
from roslings_rover.models.rooms.corridors import corridors
from roslings_rover.models.rooms.doors import rooms_with_doors
from roslings_rover.models.rooms.open_floor import open_floor
from roslings_rover.models.rooms.room import KINDS, FloorPlan, Kind, SeededRoom, StartPose
from roslings_rover.models.rooms.seeds import checked
from roslings_rover.models.world import World

PLANS: dict[Kind, Callable[[Chance], FloorPlan]] = {
    "boxes": open_floor,
    "corridors": corridors,
    "doors": rooms_with_doors,
}
AROUND_M, AHEAD_M = 0.45, 1.2
"""So much floor is free around the rover at its start, and ahead of it."""


@lru_cache(maxsize=16)
def room_of(seed: int) -> SeededRoom:
    """The room of a seed, 0 to 2 ** 64 - 1. Raises NoSeed."""
    chance = Chance(f"room 1: {checked(seed)}")
    kind = chance.pick(KINDS)
    while True:
        plan = PLANS[kind](chance)
        if start := _start(plan, chance):
            return _seen_from(start, plan, seed, kind)


def _start(plan: FloorPlan, chance: Chance) -> StartPose | None:
    """A place with free floor, and a direction in which one can drive; None where all are taken."""
    full = plan.full
    for place in plan.starts:
        if full.room_at(*place) < AROUND_M:
            continue
        for quarters in chance.shuffled(range(4)):
            if full.distance(*place, quarters * math.pi / 2) >= AHEAD_M:
                return StartPose(*place, quarters)
    return None


def _seen_from(start: StartPose, plan: FloorPlan, seed: int, kind: Kind) -> SeededRoom:
    return SeededRoom(
        seed,
        kind,
        World(start.box(plan.inside), tuple(map(start.shape, plan.obstacles))),
        tuple(map(start.track, plan.tracks)),
    )
