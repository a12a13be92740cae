"""The rover's map in letters, for a terminal without a window."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.rooms import moving_in
from roslings_rover.models.shape_arrays import Numbers, gaps
from roslings_rover.models.world import Ball, Box, Circle, World
from roslings_rover.rover.rover import Rover

Flags = NDArray[np.bool_]
Length = TypeVar("Length", float, Numbers)
Kind = Literal["floor", "wall", "drawn", "path", "ball", "moving", "believed", "rover", "said"]
ASIDE_M = 1e-6
OUTSIDE_M = 0.3
"""What is drawn so far outside of the room is still a wall of it; the rest is not shown."""
LETTER_HEIGHT = 2.0
"""A letter in a terminal is about twice as high as it is wide."""


@dataclass(frozen=True)
class MapCell:
    """One letter of the map, and what it shows."""

    letter: str
    kind: Kind
    hue: int | None = None


FLOOR = MapCell(" ", "floor")


@dataclass(frozen=True, eq=False)
class DrawnWalls:
    """Where somebody has drawn walls: the middles of small squares."""

    x_m: Numbers
    y_m: Numbers


@dataclass(frozen=True)
class Letters:
    """What a terminal can show: pictures of UTF-8, or the plain letters of ASCII."""

    frame: tuple[str, str, str, str, str, str]
    """Corners (upper left, upper right, lower left, lower right), then along and upright."""
    halves: tuple[str, str, str]
    """An obstacle in the upper half, in the lower half, in both."""
    arrows: str
    """The rover that looks east, and on, counter-clockwise, in equal steps."""
    ball: str
    moving: str
    dots: bool
    """Braille dots draw the path four times as fine as letters."""

    def of_halves(self, filled: Flags) -> Iterator[tuple[int, int, str]]:
        """Line, column and letter of each letter that is filled, of which two rows are one line."""
        upper, lower, both = self.halves
        letters = " ", upper, lower, both
        for line, column in np.argwhere(filled[::2] | filled[1::2]):
            yield line, column, letters[filled[2 * line, column] + 2 * filled[2 * line + 1, column]]


UNICODE = Letters(("┌", "┐", "└", "┘", "─", "│"), ("▀", "▄", "█"), "→↗↑↖←↙↓↘", "●", "◆", dots=True)
ASCII = Letters(("+", "+", "+", "+", "-", "|"), ("#", "#", "#"), ">^<v", "o", "@", dots=False)
BRAILLE = 0x2800
DOT_BITS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))
"""Unicode's bit for each dot, by row and column within a letter."""


def letters_for(encoding: str | None) -> Letters:
    """Those that can be written in an encoding."""
    return UNICODE if (encoding or "").lower().replace("-", "").startswith("utf") else ASCII


def size_for(world: World, columns: int, lines: int) -> tuple[int, int]:
    """Columns and lines of the largest undistorted map within so many, its frame included."""
    wide_m = world.room.east_m - world.room.west_m
    high_m = world.room.north_m - world.room.south_m
    letters_a_line = LETTER_HEIGHT * wide_m / high_m
    high = max(3, min(lines - 2, int((columns - 2) / letters_a_line)))
    return int(high * letters_a_line) + 2, high + 2


def text_map(rover: Rover, columns: int, lines: int, letters: Letters = UNICODE) -> list[str]:
    """The map as plain lines, north above, at most so many columns and lines."""
    return ["".join(cell.letter for cell in row) for row in cells(rover, columns, lines, letters)]


def cells(
    rover: Rover,
    columns: int,
    lines: int,
    letters: Letters,
    said: str = "",
    believed: Pose | None = None,
    drawn: DrawnWalls | None = None,
) -> list[list[MapCell]]:
    """The map, letter by letter; what is `said` stands over the rover.

    Where somebody believes it to be elsewhere, a second arrow stands there. What somebody has
    `drawn` of the room lies over it.
    """
    sheet = TextMap(rover.world, *size_for(rover.world, columns, lines), letters)
    sheet.put_obstacles()
    if drawn:
        sheet.put_drawn(drawn)
    sheet.put_path(rover.path)
    for thing in moving_in(rover.world):
        sheet.put_moving(thing)
    for ball in rover.world.balls:
        sheet.put_ball(ball)
    sheet.put_words(rover.pose, said)
    if believed:
        sheet.put_rover(believed, "believed")
    sheet.put_rover(rover.pose)
    return list(sheet.rows())


class TextMap:
    """A map that is being drawn."""

    def __init__(self, world: World, columns: int, lines: int, letters: Letters) -> None:
        self._world, self._letters = world, letters
        self._wide, self._high = columns - 2, lines - 2
        self._cells = [[FLOOR] * self._wide for _ in range(self._high)]
        self._balls: dict[tuple[int, int], tuple[float, float]] = {}

    def rows(self) -> Iterator[list[MapCell]]:
        """The lines from above, with the room's walls around them."""
        north_west, north_east, south_west, south_east, along, upright = self._letters.frame
        yield self._wall(north_west + along * self._wide + north_east)
        for row in self._cells:
            yield [*self._wall(upright), *row, *self._wall(upright)]
        yield self._wall(south_west + along * self._wide + south_east)

    def put_obstacles(self) -> None:
        """Obstacles, half a letter fine; what is thinner than that is drawn all the same."""
        shown = [self._not_too_thin(each) for each in self._world.obstacles]
        blocked = gaps(shown, *self._half_letters()) <= 0
        for line, column, letter in self._letters.of_halves(blocked):
            self._cells[line][column] = MapCell(letter, "wall")

    def put_drawn(self, drawn: DrawnWalls) -> None:
        """Walls that somebody has drawn; a wall that stands there keeps its form."""
        for line, column, letter in self._letters.of_halves(self._halves_of(drawn)):
            stands = self._cells[line][column]
            shown = stands.letter if stands.kind == "wall" else letter
            self._cells[line][column] = MapCell(shown, "drawn")

    def put_path(self, path: list[Pose], hue: int | None = None) -> None:
        """Where the rover went; with a hue, where there are several."""
        for pose in path:
            column, line = self._position(pose.x_m, pose.y_m)
            cell = self._cell(column, line)
            if cell and cell.kind in ("floor", "path"):
                self._set(column, line, MapCell(self._dotted(cell, column, line), "path", hue))

    def put_moving(self, thing: Circle) -> None:
        """What moves, where it is now: its middle, and as many letters as it covers."""
        columns, lines = self._letters_between(thing)
        for column in columns:
            for line in lines:
                if thing.gap(*self._place(column + 0.5, line + 0.5)) <= 0:
                    self._set(column, line, MapCell(self._letters.moving, "moving"))
        self._set(*self._position(thing.x_m, thing.y_m), MapCell(self._letters.moving, "moving"))

    def put_ball(self, ball: Ball) -> None:
        """One ball."""
        column, line = self._position(ball.x_m, ball.y_m)
        self._balls[int(column), int(line)] = column, line
        self._set(column, line, MapCell(self._letters.ball, "ball", ball.hue))

    def put_rover(self, pose: Pose, kind: Kind = "rover", hue: int | None = None) -> None:
        """The rover, as an arrow; it never covers a ball. With a hue, where there are several."""
        arrows = self._letters.arrows
        turn = round(pose.heading_rad / (2 * math.pi) * len(arrows)) % len(arrows)
        place = self._beside_a_ball(*self._position(pose.x_m, pose.y_m))
        self._set(*place, MapCell(arrows[turn], kind, hue))

    def _beside_a_ball(self, column: float, line: float) -> tuple[float, float]:
        """Where the rover and a ball share a letter: the next one, on the side where it is."""
        ball = self._balls.get((int(column), int(line)))
        if ball is None:
            return column, line
        right, below = column - ball[0], (line - ball[1]) * LETTER_HEIGHT
        if abs(right) >= abs(below):
            return _next_to(ball[0], right, self._wide), line
        return column, _next_to(ball[1], below, self._high)

    def put_words(self, pose: Pose, words: str) -> None:
        """In the line above the rover, below it where there is none; moved to where it fits."""
        column, line = self._position(pose.x_m, pose.y_m)
        shown = words[: self._wide]
        left = min(max(int(column) - len(shown) // 2, 0), self._wide - len(shown))
        row = int(line) - 1 if int(line) else int(line) + 1
        for place, letter in enumerate(shown, left):
            self._set(place, row, MapCell(letter, "said"))

    def _wall(self, text: str) -> list[MapCell]:
        return [MapCell(letter, "wall") for letter in text]

    def _dotted(self, cell: MapCell, column: float, line: float) -> str:
        if not self._letters.dots:
            return "."
        before = ord(cell.letter) - BRAILLE if cell.kind == "path" else 0
        bit = DOT_BITS[int(line % 1 * 4)][int(column % 1 * 2)]
        return chr(BRAILLE + (before | bit))

    def _not_too_thin(self, shape: Circle | Box) -> Circle | Box:
        """A wall of one letter, or half of one, at least: no thinner one is sure to be seen."""
        if isinstance(shape, Circle):
            return shape
        room = self._world.room
        letter_m = (room.east_m - room.west_m) / self._wide
        half_m = (room.north_m - room.south_m) / self._high / 2
        west_m, east_m = _at_least(letter_m, shape.west_m, shape.east_m)
        south_m, north_m = _at_least(half_m, shape.south_m, shape.north_m)
        return Box(west_m, south_m, east_m, north_m)

    def _half_letters(self) -> tuple[Numbers, Numbers]:
        """The middle of the upper and the lower half of each letter: x of columns, y of rows."""
        columns, rows = np.arange(self._wide) + 0.5, np.arange(2 * self._high) / 2 + 0.25
        x_m, y_m = self._place(columns, rows)
        return x_m[None, :], y_m[:, None]

    def _halves_of(self, drawn: DrawnWalls) -> Flags:
        """The half letters in which something is drawn."""
        room, halves = self._world.room, np.zeros((2 * self._high, self._wide), bool)
        across = (drawn.x_m - room.west_m) / (room.east_m - room.west_m) * self._wide
        down = (room.north_m - drawn.y_m) / (room.north_m - room.south_m) * 2 * self._high
        near = (drawn.x_m >= room.west_m - OUTSIDE_M) & (drawn.x_m <= room.east_m + OUTSIDE_M)
        near &= (drawn.y_m >= room.south_m - OUTSIDE_M) & (drawn.y_m <= room.north_m + OUTSIDE_M)
        columns = np.clip(across[near].astype(int), 0, self._wide - 1)
        halves[np.clip(down[near].astype(int), 0, 2 * self._high - 1), columns] = True
        return halves

    def _letters_between(self, thing: Circle) -> tuple[range, range]:
        """The columns and lines that something round reaches into."""
        x_m, y_m, r = thing.x_m, thing.y_m, thing.radius_m
        left, top = self._position(x_m - r, y_m + r)
        right, low = self._position(x_m + r, y_m - r)
        return range(int(left), int(right) + 1), range(int(top), int(low) + 1)

    def _place(self, column: Length, line: Length) -> tuple[Length, Length]:
        """Where in the room a column and a line are, with fractions."""
        room = self._world.room
        x_m = room.west_m + column / self._wide * (room.east_m - room.west_m)
        y_m = room.north_m - line / self._high * (room.north_m - room.south_m)
        return x_m, y_m

    def _position(self, x_m: float, y_m: float) -> tuple[float, float]:
        """Column and line, with fractions; what lies on a wall is drawn inside of it."""
        room = self._world.room
        column = (x_m - room.west_m) / (room.east_m - room.west_m) * self._wide
        line = (room.north_m - y_m) / (room.north_m - room.south_m) * self._high
        return min(max(column, 0.0), self._wide - 1e-6), min(max(line, 0.0), self._high - 1e-6)

    def _cell(self, column: float, line: float) -> MapCell:
        return self._cells[int(line)][int(column)]

    def _set(self, column: float, line: float, cell: MapCell) -> None:
        self._cells[int(line)][int(column)] = cell


def _next_to(place: float, side: float, count: int) -> float:
    """The letter before `place` or behind it, on the `side` of this sign where there is one."""
    step = 1 if side >= 0 else -1
    return place + step if 0 <= place + step < count else place - step


def _at_least(least_m: float, low_m: float, high_m: float) -> tuple[float, float]:
    """The same ends, or ends so far apart; a little aside, so that no two letters share them."""
    if high_m - low_m >= least_m:
        return low_m, high_m
    low_m = (low_m + high_m - least_m) / 2 - ASIDE_M
    return low_m, low_m + least_m
