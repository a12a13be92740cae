"""Rooms with doors: a wall with a door cuts a floor in two, another one each half, and so on.

Each room is reached, since each wall has a door of its own, and no later wall meets it near there.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from roslings_rover.models.drives.chance import Chance
from roslings_rover.models.rooms.furniture import TINY_M, Area, drawn
from roslings_rover.models.rooms.open_floor import place_on
from roslings_rover.models.rooms.room import PASSAGE_M, FloorPlan, apart_m
from roslings_rover.models.world import Box

WIDE_M, HIGH_M = (7.5, 9.0), (5.5, 7.5)
SMALLEST_M = 2.5
"""The shorter side of a room."""
WALL_M = 0.1
DOOR_M = PASSAGE_M
BESIDE_DOOR_M = 0.3
"""So far from a door no other wall begins."""
TWO_DOORS_FROM_M, TWO_DOORS = 4.0, 0.4
"""Of walls of this length so many have two doors: then there is a way round."""
TRIES = 20
THINGS = range(3)
"""In one room."""
STARTS_A_ROOM = 20
MOST_TRACKS = 2


@dataclass
class House:
    """What is built so far."""

    walls: list[Box] = field(default_factory=list)
    doors: list[Box] = field(default_factory=list)
    rooms: list[Box] = field(default_factory=list)

    def divide(self, floor: Box, chance: Chance) -> None:
        """Cut a floor in two, and its halves again, as long as they are large enough."""
        wall = self._place_for_wall(floor, chance)
        if wall is None:
            self.rooms.append(floor)
            return
        self._build(wall, chance)
        for half in _halves(floor, wall):
            self.divide(half, chance)

    def _place_for_wall(self, floor: Box, chance: Chance) -> Box | None:
        """Across the longer side; None where the floor is small, or doors are in the way."""
        wide_m, high_m = _sides(floor)
        if max(wide_m, high_m) < 2 * SMALLEST_M + WALL_M:
            return None
        walls = (_wall_across(floor, wide_m >= high_m, chance) for _ in range(TRIES))
        return next((wall for wall in walls if self._meets_no_door(wall)), None)

    def _meets_no_door(self, wall: Box) -> bool:
        """At its ends, where it meets other walls."""
        upright = _is_upright(wall)
        dx, dy = (BESIDE_DOOR_M, 2 * WALL_M) if upright else (2 * WALL_M, BESIDE_DOOR_M)
        near = Box(wall.west_m - dx, wall.south_m - dy, wall.east_m + dx, wall.north_m + dy)
        return all(apart_m(near, door) >= -TINY_M for door in self.doors)

    def _build(self, wall: Box, chance: Chance) -> None:
        """The wall, with its doors."""
        low_m, high_m = _span(wall)
        doors = [_along(wall, begin_m, begin_m + DOOR_M) for begin_m in _doors(wall, chance)]
        ends = [low_m, *(end for door in doors for end in _span(door)), high_m]
        self.doors += doors
        self.walls += [_along(wall, *piece) for piece in zip(ends[::2], ends[1::2], strict=True)]

    def areas(self) -> Iterator[Area]:
        """The rooms, with the doors that lead into each."""
        for room in self.rooms:
            yield Area(room, keeps_free=[d for d in self.doors if apart_m(room, d) <= TINY_M])


def rooms_with_doors(chance: Chance) -> FloorPlan:
    """A house, furnished; another one is drawn where no room is large enough for what moves."""
    while True:
        inside = Box(0.0, 0.0, drawn(chance, *WIDE_M), drawn(chance, *HIGH_M))
        house = House()
        house.divide(inside, chance)
        areas = list(house.areas())
        wanted = chance.pick(range(1, MOST_TRACKS + 1))
        moving = [area for area in chance.shuffled(areas) if area.add_track(chance)]
        if moving:
            break
    for area in moving[wanted:]:
        area.tracks.clear()
    for area in areas:
        area.furnish(chance, chance.pick(THINGS))
    return _plan(inside, house, areas, chance)


def _plan(inside: Box, house: House, areas: list[Area], chance: Chance) -> FloorPlan:
    things = (thing for area in areas for thing in area.things)
    tracks = tuple(track for area in areas for track in area.tracks)
    starts = [place_on(area.floor, chance) for area in areas for _ in range(STARTS_A_ROOM)]
    return FloorPlan(inside, (*house.walls, *things), tracks, tuple(chance.shuffled(starts)))


def _doors(wall: Box, chance: Chance) -> list[float]:
    """Where the doors of a wall begin, along it."""
    low_m, high_m = _span(wall)
    first_m, last_m = low_m + BESIDE_DOOR_M, high_m - BESIDE_DOOR_M - DOOR_M
    if high_m - low_m < TWO_DOORS_FROM_M or chance.between(0, 1) >= TWO_DOORS:
        return [drawn(chance, first_m, last_m)]
    middle_m = (low_m + high_m) / 2
    one_m = drawn(chance, first_m, middle_m - BESIDE_DOOR_M - DOOR_M)
    return [one_m, drawn(chance, middle_m + BESIDE_DOOR_M, last_m)]


def _wall_across(floor: Box, upright: bool, chance: Chance) -> Box:
    if upright:
        at_m = drawn(chance, floor.west_m + SMALLEST_M, floor.east_m - SMALLEST_M - WALL_M)
        return Box(at_m, floor.south_m, at_m + WALL_M, floor.north_m)
    at_m = drawn(chance, floor.south_m + SMALLEST_M, floor.north_m - SMALLEST_M - WALL_M)
    return Box(floor.west_m, at_m, floor.east_m, at_m + WALL_M)


def _halves(floor: Box, wall: Box) -> tuple[Box, Box]:
    if _is_upright(wall):
        return (
            Box(floor.west_m, floor.south_m, wall.west_m, floor.north_m),
            Box(wall.east_m, floor.south_m, floor.east_m, floor.north_m),
        )
    return (
        Box(floor.west_m, floor.south_m, floor.east_m, wall.south_m),
        Box(floor.west_m, wall.north_m, floor.east_m, floor.north_m),
    )


def _sides(box: Box) -> tuple[float, float]:
    return box.east_m - box.west_m, box.north_m - box.south_m


def _is_upright(wall: Box) -> bool:
    wide_m, high_m = _sides(wall)
    return wide_m < high_m


def _span(wall: Box) -> tuple[float, float]:
    """From where to where it goes, or what stands in it."""
    return (wall.south_m, wall.north_m) if _is_upright(wall) else (wall.west_m, wall.east_m)


def _along(wall: Box, begin_m: float, end_m: float) -> Box:
    """A part of a wall."""
    if _is_upright(wall):
        return Box(wall.west_m, begin_m, wall.east_m, end_m)
    return Box(begin_m, wall.south_m, end_m, wall.north_m)
