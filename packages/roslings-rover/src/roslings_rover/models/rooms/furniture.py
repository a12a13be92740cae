"""What stands on a free floor, and what moves there: each thing leaves a way around it.

A thing stands free, with a passage all around, or leans on one wall, with a passage around the
rest. So no thing, and no two of them, ever close a way.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Literal

from roslings_rover.models.drives.chance import Chance
from roslings_rover.models.rooms.room import PASSAGE_M, Place, Track, apart_m
from roslings_rover.models.world import Box, Circle

Side = Literal["west", "south", "east", "north"]
SIDES: tuple[Side, ...] = ("west", "south", "east", "north")
GRID_M = 0.05
"""All places are multiples of it: a room is written down in few digits."""
TINY_M = 1e-6
TRIES = 40
MOVES_M = 1.1
"""A thing that moves comes so far out of the middle, up to the wall."""
NEAREST_WALL_M = 0.1
"""There it turns round: nobody passes between it and the wall."""
RADII_M, SPEEDS_M_S = (0.15, 0.2), (0.15, 0.2, 0.25, 0.3)
RESTS_HOME_S, RESTS_AWAY_S = (2.0, 6.0), (1.0, 3.0)


def on_grid(value_m: float) -> float:
    """The nearest place of the grid."""
    return round(round(value_m / GRID_M) * GRID_M, 2)


def drawn(chance: Chance, low_m: float, high_m: float) -> float:
    """A place of the grid between two of it."""
    steps = round((high_m - low_m) / GRID_M)
    return on_grid(low_m + chance.pick(range(steps + 1)) * GRID_M)


@dataclass
class Area:
    """A floor between four walls, and what stands on it so far."""

    floor: Box
    things: list[Circle | Box] = field(default_factory=list)
    tracks: list[Track] = field(default_factory=list)
    keeps_free: Sequence[Box] = ()
    """Doors in its walls."""

    @property
    def wide_m(self) -> float:
        """From west to east."""
        return self.floor.east_m - self.floor.west_m

    @property
    def high_m(self) -> float:
        """From south to north."""
        return self.floor.north_m - self.floor.south_m

    def furnish(self, chance: Chance, count: int) -> None:
        """Put at most so many things on it; fewer where no more find a place."""
        for _ in range(TRIES):
            if len(self.things) >= count:
                return
            thing = chance.pick(MAKERS)(self, chance)
            if thing and self._has_room_for(thing):
                self.things.append(thing)

    def add_track(self, chance: Chance) -> bool:
        """Let something move on it, from the floor to a wall and back; False without a place."""
        for _ in range(TRIES):
            radius_m = chance.pick(RADII_M)
            deep_m = NEAREST_WALL_M + 2 * radius_m + MOVES_M
            side = chance.pick(SIDES)
            swept = self.leaning(chance, side, on_grid(2 * radius_m), on_grid(deep_m))
            if swept and self._has_room_for(swept):
                self.tracks.append(_track(swept, side, radius_m, chance))
                return True
        return False

    def _has_room_for(self, thing: Circle | Box) -> bool:
        others = (*self.things, *(track.swept for track in self.tracks), *self.keeps_free)
        return all(apart_m(thing, other) >= PASSAGE_M - TINY_M for other in others)

    def free_corner(self, chance: Chance, wide_m: float, high_m: float) -> Place | None:
        """The south-west corner of what stands free; None where the floor is too small for it."""
        floor, way = self.floor, PASSAGE_M
        if self.wide_m < wide_m + 2 * way or self.high_m < high_m + 2 * way:
            return None
        return (
            drawn(chance, floor.west_m + way, floor.east_m - way - wide_m),
            drawn(chance, floor.south_m + way, floor.north_m - way - high_m),
        )

    def leaning(self, chance: Chance, side: Side, along_m: float, deep_m: float) -> Box | None:
        """A box against a wall; None where the floor is too small for it."""
        upright = side in ("west", "east")
        length_m, depth_m = (self.high_m, self.wide_m) if upright else (self.wide_m, self.high_m)
        if length_m < along_m + 2 * PASSAGE_M or depth_m < deep_m + PASSAGE_M:
            return None
        begin_m = self.floor.south_m if upright else self.floor.west_m
        at_m = drawn(chance, begin_m + PASSAGE_M, begin_m + length_m - PASSAGE_M - along_m)
        return against(self.floor, side, at_m, along_m, deep_m)


def against(floor: Box, side: Side, at_m: float, along_m: float, deep_m: float) -> Box:
    """A box that leans on one side of a floor, from `at_m` on, along it."""
    upto_m = at_m + along_m
    if side == "west":
        return Box(floor.west_m, at_m, floor.west_m + deep_m, upto_m)
    if side == "east":
        return Box(floor.east_m - deep_m, at_m, floor.east_m, upto_m)
    if side == "south":
        return Box(at_m, floor.south_m, upto_m, floor.south_m + deep_m)
    return Box(at_m, floor.north_m - deep_m, upto_m, floor.north_m)


def _track(swept: Box, side: Side, radius_m: float, chance: Chance) -> Track:
    """Along the middle of a box; home is away from the wall."""
    near, far = NEAREST_WALL_M + radius_m, radius_m
    middle_x, middle_y = (swept.west_m + swept.east_m) / 2, (swept.south_m + swept.north_m) / 2
    ends: dict[Side, tuple[Place, Place]] = {
        "west": ((swept.east_m - far, middle_y), (swept.west_m + near, middle_y)),
        "east": ((swept.west_m + far, middle_y), (swept.east_m - near, middle_y)),
        "south": ((middle_x, swept.north_m - far), (middle_x, swept.south_m + near)),
        "north": ((middle_x, swept.south_m + far), (middle_x, swept.north_m - near)),
    }
    return track_between(*ends[side], radius_m, chance)


def track_between(home: Place, turn: Place, radius_m: float, chance: Chance) -> Track:
    """A track with these ends; how something goes there is drawn."""
    return Track(
        home,
        turn,
        radius_m,
        speed_m_s=chance.pick(SPEEDS_M_S),
        rests_home_s=round(chance.between(*RESTS_HOME_S), 1),
        rests_away_s=round(chance.between(*RESTS_AWAY_S), 1),
    )


def _crate(area: Area, chance: Chance) -> Box | None:
    wide_m, high_m = drawn(chance, 0.3, 1.2), drawn(chance, 0.3, 1.2)
    corner = area.free_corner(chance, wide_m, high_m)
    return Box(*corner, corner[0] + wide_m, corner[1] + high_m) if corner else None


def _bin(area: Area, chance: Chance) -> Circle | None:
    radius_m = drawn(chance, 0.15, 0.4)
    corner = area.free_corner(chance, 2 * radius_m, 2 * radius_m)
    return Circle(corner[0] + radius_m, corner[1] + radius_m, radius_m) if corner else None


def _shelf(area: Area, chance: Chance) -> Box | None:
    along_m, deep_m = drawn(chance, 0.6, 2.0), drawn(chance, 0.25, 0.6)
    return area.leaning(chance, chance.pick(SIDES), along_m, deep_m)


def _screen(area: Area, chance: Chance) -> Box | None:
    """A thin wall that stands out from a wall."""
    return area.leaning(chance, chance.pick(SIDES), 0.1, drawn(chance, 0.8, 1.8))


MAKERS: tuple[Callable[[Area, Chance], Circle | Box | None], ...] = (_crate, _bin, _shelf, _screen)
