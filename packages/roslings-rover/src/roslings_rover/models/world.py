"""What stands around the rover: a room, obstacles in it, and balls to look for."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Protocol


class Shape(Protocol):
    """Something on the floor that a ray can hit and that the rover can touch."""

    def hit(self, x_m: float, y_m: float, angle_rad: float) -> float:
        """How far a ray from (x, y) goes until it hits; infinity where it misses."""
        ...

    def gap(self, x_m: float, y_m: float) -> float:
        """How far (x, y) is from the shape; negative inside of it."""
        ...


@dataclass(frozen=True)
class Circle:
    """A round obstacle, such as a bin."""

    x_m: float
    y_m: float
    radius_m: float

    def hit(self, x_m: float, y_m: float, angle_rad: float) -> float:
        """The nearer root of |start + t * direction - centre| = radius; 0 from inside."""
        dx, dy = self.x_m - x_m, self.y_m - y_m
        along_m = dx * math.cos(angle_rad) + dy * math.sin(angle_rad)
        inside = dx * dx + dy * dy - self.radius_m**2
        if inside <= 0:
            return 0.0
        root = along_m * along_m - inside
        return along_m - math.sqrt(root) if root >= 0 and along_m > 0 else math.inf

    def gap(self, x_m: float, y_m: float) -> float:
        """Distance to the rim."""
        return math.hypot(x_m - self.x_m, y_m - self.y_m) - self.radius_m


@dataclass(frozen=True)
class Box:
    """An obstacle with four sides along x and y, such as a wall or a crate."""

    west_m: float
    south_m: float
    east_m: float
    north_m: float

    def hit(self, x_m: float, y_m: float, angle_rad: float) -> float:
        """Where the ray is between west and east and between south and north at once."""
        spans = (
            _span(x_m, math.cos(angle_rad), self.west_m, self.east_m),
            _span(y_m, math.sin(angle_rad), self.south_m, self.north_m),
        )
        enters, leaves = max(s[0] for s in spans), min(s[1] for s in spans)
        return max(enters, 0.0) if leaves >= max(enters, 0.0) else math.inf

    def gap(self, x_m: float, y_m: float) -> float:
        """Distance to the nearest side."""
        dx = max(self.west_m - x_m, x_m - self.east_m)
        dy = max(self.south_m - y_m, y_m - self.north_m)
        outside_m = math.hypot(max(dx, 0.0), max(dy, 0.0))
        return outside_m if outside_m > 0 else max(dx, dy)


def _span(start_m: float, slope: float, low_m: float, high_m: float) -> tuple[float, float]:
    """From where to where along the ray one coordinate lies between two limits."""
    if abs(slope) < 1e-12:
        return (-math.inf, math.inf) if low_m <= start_m <= high_m else (math.inf, -math.inf)
    one, two = (low_m - start_m) / slope, (high_m - start_m) / slope
    return min(one, two), max(one, two)


@dataclass(frozen=True)
class Ball:
    """A coloured ball that lies on the floor. The camera sees it, and the rover can hit it."""

    x_m: float
    y_m: float
    radius_m: float = 0.10
    hue: int = 5
    """Its colour as OpenCV counts: 0 to 179, where 0 is red, 60 green and 120 blue."""

    @property
    def shape(self) -> Circle:
        """What rays hit."""
        return Circle(self.x_m, self.y_m, self.radius_m)

    @property
    def colour(self) -> str:
        """Its colour in a word."""
        return colour_of(self.hue)


HUES = ((15, "red"), (35, "yellow"), (85, "green"), (100, "cyan"), (130, "blue"), (165, "magenta"))
"""Where each colour ends on the wheel of hues; after the last one it is red again."""


def colour_of(hue: int) -> str:
    """The word for a hue, which a terminal knows, too."""
    return next((name for upto, name in HUES if hue < upto), "red")


@dataclass(frozen=True)
class World:
    """A room (its inside), the obstacles in it, and the balls."""

    room: Box
    obstacles: tuple[Circle | Box, ...] = ()
    balls: tuple[Ball, ...] = field(default=())

    @property
    def shapes(self) -> tuple[Circle | Box, ...]:
        """All that can be hit inside the room."""
        return (*self.obstacles, *(ball.shape for ball in self.balls))

    def distance(
        self, x_m: float, y_m: float, angle_rad: float, among: Sequence[Shape] | None = None
    ) -> float:
        """How far one can look from (x, y) in a direction, in metres; the room's walls end it."""
        shapes: Iterable[Shape] = self.shapes if among is None else among
        nearest_m = min((s.hit(x_m, y_m, angle_rad) for s in shapes), default=math.inf)
        return min(nearest_m, self._to_the_wall(x_m, y_m, angle_rad))

    def room_at(self, x_m: float, y_m: float) -> float:
        """Distance from (x, y) to whatever is nearest; negative inside something."""
        to_wall_m = -self.room.gap(x_m, y_m)
        return min([to_wall_m, *(shape.gap(x_m, y_m) for shape in self.shapes)])

    def _to_the_wall(self, x_m: float, y_m: float, angle_rad: float) -> float:
        room = self.room
        ways = (
            _span(x_m, math.cos(angle_rad), room.west_m, room.east_m)[1],
            _span(y_m, math.sin(angle_rad), room.south_m, room.north_m)[1],
        )
        return max(0.0, min(ways))


def default_world() -> World:
    """The course's room: 10 by 9 m, four obstacles and a ball.

    A rover can drive straight from (0, 0) to (3, 5).
    """
    return World(
        room=Box(-2.0, -2.0, 8.0, 7.0),
        obstacles=(
            Box(2.0, 2.0, 4.4, 2.5),
            Box(5.5, 3.5, 6.0, 7.0),
            Circle(0.0, 4.5, 0.5),
            Circle(5.5, 0.0, 0.4),
        ),
        balls=(Ball(2.0, 0.6),),
    )
