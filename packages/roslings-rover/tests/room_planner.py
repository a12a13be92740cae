"""A planner for rooms, and a driver that follows its route: does a way exist, and can it be driven?

The planner floods a grid (C. Lee, "An Algorithm for Path Connections and Its Applications", 1961).
It asks for so much floor around the rover that the line between two free cells is free, too: no
point of it is farther than half a step from one of them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from roslings_rover.models.differential_drive import Motion
from roslings_rover.models.rooms import SeededRoom
from roslings_rover.models.shape_arrays import gaps
from roslings_rover.models.world import Box, Circle
from roslings_rover.rover.in_room import RoomRover

STEP_M = 0.1
CLEAR_M = 0.25
"""Of the middle of the rover, whose radius is 0.12 m."""
Cell = tuple[int, int]
Place = tuple[float, float]
Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class Grid:
    """The floor of a room in cells; which are free, and how many steps each is from the start."""

    room: SeededRoom
    in_the_way: Sequence[Circle | Box]
    """What moves, or where it may be."""

    @cached_property
    def free(self) -> Flags:
        """Where the middle of a rover can be."""
        inside = self.room.world.room
        x_m, y_m = self._axes
        to_walls = np.minimum(
            np.minimum(x_m - inside.west_m, inside.east_m - x_m)[:, None],
            np.minimum(y_m - inside.south_m, inside.north_m - y_m)[None, :],
        )
        shapes = (*self.room.world.obstacles, *self.in_the_way)
        around = gaps(shapes, x_m[:, None], y_m[None, :])
        return np.minimum(to_walls, around) >= CLEAR_M

    @cached_property
    def _axes(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        inside = self.room.world.room
        return (
            self._lines(inside.west_m, inside.east_m),
            self._lines(inside.south_m, inside.north_m),
        )

    def _lines(self, low_m: float, high_m: float) -> NDArray[np.float64]:
        """Such that the start, at 0, lies on one."""
        first, last = math.ceil(low_m / STEP_M), math.floor(high_m / STEP_M)
        return np.arange(first, last + 1) * STEP_M

    @cached_property
    def origin(self) -> Cell:
        """The cell of the start."""
        inside = self.room.world.room
        return -math.ceil(inside.west_m / STEP_M), -math.ceil(inside.south_m / STEP_M)

    def place(self, cell: Cell) -> Place:
        """Its middle, in metres."""
        return (cell[0] - self.origin[0]) * STEP_M, (cell[1] - self.origin[1]) * STEP_M

    @cached_property
    def steps(self) -> NDArray[np.int32]:
        """From the start to each cell; -1 where there is no way."""
        found = np.full(self.free.shape, -1, np.int32)
        front = np.zeros(self.free.shape, np.bool_)
        front[self.origin] = self.free[self.origin]
        number = 0
        while front.any():
            found[front] = number
            front = _grown(front) & self.free & (found < 0)
            number += 1
        return found

    @property
    def left_out(self) -> list[Place]:
        """Free floor to which no way leads."""
        return [self.place((int(i), int(j))) for i, j in np.argwhere(self.free & (self.steps < 0))]

    @cached_property
    def farthest(self) -> Cell:
        """The cell to which the way is longest."""
        column, row = np.unravel_index(int(self.steps.argmax()), self.steps.shape)
        return int(column), int(row)

    def route(self, goal: Cell) -> list[Place]:
        """From the start to a cell that can be reached."""
        cells = [goal]
        while (number := int(self.steps[cells[-1]])) > 0:
            cells.append(next(c for c in _beside(cells[-1]) if self._number(c) == number - 1))
        return [self.place(cell) for cell in reversed(cells)]

    def _number(self, cell: Cell) -> int:
        wide, high = self.steps.shape
        return int(self.steps[cell]) if 0 <= cell[0] < wide and 0 <= cell[1] < high else -1


def _grown(front: Flags) -> Flags:
    """These cells, and the four beside each."""
    padded = np.pad(front, 1)
    across = padded[:-2, 1:-1] | padded[2:, 1:-1]
    found: Flags = front | across | padded[1:-1, :-2] | padded[1:-1, 2:]
    return found


def _beside(cell: Cell) -> list[Cell]:
    column, row = cell
    return [(column + 1, row), (column, row + 1), (column - 1, row), (column, row - 1)]


# --- driving -----------------------------------------------------------------------------------

TICK_S, FORWARD_M_S, NEAR_M = 0.05, 0.3, 0.08
AHEAD_RAD, TURN_GAIN = 0.3, 3.0
WAITS_M, BESIDE_M = 0.25, 0.05
LONGEST_S = 600.0


def drive_along(rover: RoomRover, route: Sequence[Place]) -> bool:
    """Follow a route as it is, and wait for what is in the way; whether the end was reached."""
    for place in route:
        while math.dist((rover.pose.x_m, rover.pose.y_m), place) > NEAR_M:
            if rover.time_s > LONGEST_S:
                return False
            rover.drive(_towards(rover, place))
            rover.step(TICK_S)
    return True


def _towards(rover: RoomRover, place: Place) -> Motion:
    ahead_m, left_m = rover.pose.seen_from_here(*place)
    off_rad = math.atan2(left_m, ahead_m)
    if abs(off_rad) > AHEAD_RAD:
        return Motion(0.0, TURN_GAIN * off_rad)
    return Motion() if _is_held_up(rover) else Motion(FORWARD_M_S, TURN_GAIN * off_rad)


def _is_held_up(rover: RoomRover) -> bool:
    """Something that moves is near, and where the rover would drive."""
    return any(_is_before(rover, thing) for thing in rover.world.moving)


def _is_before(rover: RoomRover, thing: Circle) -> bool:
    ahead_m, left_m = rover.pose.seen_from_here(thing.x_m, thing.y_m)
    both_m = rover.body.radius_m + thing.radius_m
    return 0 < ahead_m < both_m + WAITS_M and abs(left_m) < both_m + BESIDE_M
