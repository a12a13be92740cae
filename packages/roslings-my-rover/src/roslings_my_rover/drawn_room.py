"""The room as a student's node has drawn it on /map: its walls in metres, and all of it in letters.

A map comes from a program that may say anything: what is no map is refused, with the reason.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from roslings_rover.rover.text_map import LETTER_HEIGHT, DrawnWalls, Flags, Letters

OCCUPIED = 100
"""By the card of day 12, as 0 is free, and -1 unknown."""
MOST_CELLS = 4_000_000
"""A larger map would hold up the rover."""


class NotDrawable(Exception):
    """A message that cannot be drawn; its text is what is wrong, at most 60 columns."""


@dataclass(frozen=True, eq=False)
class DrawnRoom:
    """Cells in rows, the first row in the south."""

    frame: str
    walls: Flags
    free: Flags
    walls_m: DrawnWalls
    """The same walls, as places in the frame."""

    @property
    def counts(self) -> str:
        """`312 cells of walls and 9876 free ones`."""
        return f"{self.walls.sum()} cells of walls and {self.free.sum()} free ones"

    def lines(self, columns: int, lines: int, letters: Letters) -> Iterator[str]:
        """What is known of the room, north above, at most so many columns and lines."""
        known = self.walls | self.free
        if not known.any():
            return
        rows, across = (np.flatnonzero(known.any(axis)) for axis in (1, 0))
        part = slice(rows[0], rows[-1] + 1), slice(across[0], across[-1] + 1)
        size = _half_letter_cells(self.walls[part].shape, columns, lines)
        walls, free = (_larger(cells[part], size) for cells in (self.walls, self.free))
        shown = np.where(free[::2] | free[1::2], "·" if letters.dots else ".", " ")
        for line, column, letter in letters.of_halves(walls):
            shown[line, column] = letter
        yield from ("".join(row).rstrip() for row in shown)


def drawn_room(grid: Any) -> DrawnRoom:
    """What a nav_msgs/msg/OccupancyGrid says. Raises NotDrawable."""
    info = grid.info
    wide, high, count = info.width, info.height, len(grid.data)
    if not count or count != wide * high:
        raise NotDrawable(f"/map has {count} cells, and not {wide} x {high}.")
    if count > MOST_CELLS:
        raise NotDrawable(f"/map has {count} cells: that is too many.")
    corner = info.origin.position
    if not (all(map(math.isfinite, (info.resolution, corner.x, corner.y))) and info.resolution > 0):
        raise NotDrawable("/map does not say where its cells are.")
    cells = np.asarray(grid.data).reshape(high, wide)
    walls = cells >= OCCUPIED
    row, column = np.nonzero(walls)
    middles = (
        corner.x + (column + 0.5) * info.resolution,
        corner.y + (row + 0.5) * info.resolution,
    )
    return DrawnRoom(
        grid.header.frame_id,
        walls,
        (cells >= 0) & ~walls,
        DrawnWalls(*middles),
    )


def _half_letter_cells(shape: tuple[int, ...], columns: int, lines: int) -> float:
    """How many cells wide and high half a letter is, so that all of them find room; at least one.

    A letter is twice as high as it is wide.
    """
    high, wide = shape
    return max(1.0, wide / columns, high / (LETTER_HEIGHT * lines))


def _larger(cells: Flags, size: float) -> Flags:
    """Squares of so many cells, each filled where one of its cells is; the first row in the north.

    The rows are even in number: two make a line of letters.
    """
    high, wide = (math.ceil(length / size - 1e-9) for length in cells.shape)
    filled = np.zeros((high + high % 2, wide), bool)
    row, column = np.nonzero(cells[::-1])
    filled[(row / size).astype(int), (column / size).astype(int)] = True
    return filled
