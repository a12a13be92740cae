"""An open floor with boxes: one large room, and things that stand free or lean on its walls."""

from __future__ import annotations

from roslings_rover.models.drives.chance import Chance
from roslings_rover.models.rooms.furniture import Area, drawn
from roslings_rover.models.rooms.room import FloorPlan, Place
from roslings_rover.models.world import Box

WIDE_M, HIGH_M = (6.5, 9.0), (5.5, 7.0)
THINGS = range(5, 11)
STARTS = 60


def open_floor(chance: Chance) -> FloorPlan:
    """What moves comes first, so that it always finds its place."""
    area = Area(Box(0.0, 0.0, drawn(chance, *WIDE_M), drawn(chance, *HIGH_M)))
    for _ in range(chance.pick((1, 2))):
        area.add_track(chance)
    area.furnish(chance, chance.pick(THINGS))
    starts = tuple(place_on(area.floor, chance) for _ in range(STARTS))
    return FloorPlan(area.floor, tuple(area.things), tuple(area.tracks), starts)


def place_on(floor: Box, chance: Chance) -> Place:
    """Any place of a floor."""
    return (
        drawn(chance, floor.west_m, floor.east_m),
        drawn(chance, floor.south_m, floor.north_m),
    )
