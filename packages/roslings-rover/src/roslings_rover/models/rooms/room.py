"""A room from a seed: what stands in it, and what moves to and fro."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

from roslings_rover.models.world import Box, Circle, World

Kind = Literal["boxes", "corridors", "doors"]
KINDS: tuple[Kind, ...] = ("boxes", "corridors", "doors")
IN_WORDS: dict[Kind, str] = {
    "boxes": "an open floor with boxes",
    "corridors": "corridors",
    "doors": "rooms with doors",
}

PASSAGE_M = 1.0
"""No way between two things is narrower; where there is no way, they touch."""

PAST_M = 0.7
"""So much floor is free beside what moves, wherever it is, on the side where no wall is."""

Place = tuple[float, float]
"""x and y in metres."""


@dataclass(frozen=True)
class Track:
    """The line on which a round thing goes to and fro, and how it goes there."""

    home: Place
    """Here it rests, and here it is at first: it is in nobody's way."""
    turn: Place
    """Here it turns round: it has come into the way."""
    radius_m: float
    speed_m_s: float
    rests_home_s: float
    rests_away_s: float

    @cached_property
    def length_m(self) -> float:
        """From one end to the other."""
        return math.dist(self.home, self.turn)

    def at(self, along_m: float) -> Circle:
        """The thing, so far from its home."""
        part = along_m / self.length_m
        x_m, y_m = (h + (t - h) * part for h, t in zip(self.home, self.turn, strict=True))
        return Circle(x_m, y_m, self.radius_m)

    @property
    def swept(self) -> Box:
        """All the floor that it ever covers; its corners, too, which it does not."""
        (x1, y1), (x2, y2), r = self.home, self.turn, self.radius_m
        return Box(min(x1, x2) - r, min(y1, y2) - r, max(x1, x2) + r, max(y1, y2) + r)


@dataclass(frozen=True)
class MovingWorld(World):
    """A world of which a part moves: `moving` is where that is now."""

    moving: tuple[Circle, ...] = ()

    @property
    def shapes(self) -> tuple[Circle | Box, ...]:
        """All that can be hit inside the room."""
        return (*super().shapes, *self.moving)


def moving_in(world: World) -> tuple[Circle, ...]:
    """What moves in a world, where it is now; nothing in the course's own room."""
    return world.moving if isinstance(world, MovingWorld) else ()


@dataclass(frozen=True)
class SeededRoom:
    """A room. The rover starts at (0, 0) and looks along x; the floor ahead of it is free."""

    seed: int
    kind: Kind
    world: World
    """What does not move."""
    tracks: tuple[Track, ...]

    def world_with(self, moving: tuple[Circle, ...]) -> MovingWorld:
        """All of it, with the things that move at these places."""
        return MovingWorld(self.world.room, self.world.obstacles, self.world.balls, moving)

    @property
    def at_first(self) -> MovingWorld:
        """All of it, before anything has moved."""
        return self.world_with(tuple(track.at(0.0) for track in self.tracks))


@dataclass(frozen=True)
class FloorPlan:
    """A room before it is known where the rover starts."""

    inside: Box
    obstacles: tuple[Circle | Box, ...]
    tracks: tuple[Track, ...]
    starts: tuple[Place, ...]
    """Places that may do; some may be taken."""

    @property
    def full(self) -> World:
        """As if each thing were on all of its track at once."""
        return World(self.inside, (*self.obstacles, *(track.swept for track in self.tracks)))


@dataclass(frozen=True)
class StartPose:
    """Where a rover starts in a plan, and in how many quarter turns from x it looks."""

    x_m: float
    y_m: float
    quarters: int

    def seen(self, x_m: float, y_m: float) -> Place:
        """A place of the plan, as it is for who starts here: this is (0, 0), and x is ahead."""
        dx, dy = x_m - self.x_m, y_m - self.y_m
        x, y = ((dx, dy), (dy, -dx), (-dx, -dy), (-dy, dx))[self.quarters]
        return round(x, 3) + 0.0, round(y, 3) + 0.0

    def shape(self, shape: Circle | Box) -> Circle | Box:
        """The same of a thing."""
        return self.box(shape) if isinstance(shape, Box) else self._circle(shape)

    def box(self, box: Box) -> Box:
        """The same of a box."""
        one, two = self.seen(box.west_m, box.south_m), self.seen(box.east_m, box.north_m)
        (west, east), (south, north) = (sorted(pair) for pair in zip(one, two, strict=True))
        return Box(west, south, east, north)

    def _circle(self, circle: Circle) -> Circle:
        return Circle(*self.seen(circle.x_m, circle.y_m), circle.radius_m)

    def track(self, track: Track) -> Track:
        """The same of a track."""
        return replace(track, home=self.seen(*track.home), turn=self.seen(*track.turn))


def apart_m(one: Circle | Box, two: Circle | Box) -> float:
    """The floor between two things; 0 or less where they touch."""
    if isinstance(one, Circle):
        return two.gap(one.x_m, one.y_m) - one.radius_m
    if isinstance(two, Circle):
        return apart_m(two, one)
    off_x = max(two.west_m - one.east_m, one.west_m - two.east_m)
    off_y = max(two.south_m - one.north_m, one.south_m - two.north_m)
    if off_x <= 0 and off_y <= 0:
        return max(off_x, off_y)
    return math.hypot(max(off_x, 0.0), max(off_y, 0.0))
