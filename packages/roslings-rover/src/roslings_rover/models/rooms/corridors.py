"""Corridors: a maze of equal cells, with some loops. What moves comes out of a dead end.

It goes along one wall, so one can drive past it on the other side, wherever it is.

Each cell is reached from each other one. The corridors begin as a tree that spans all cells (a
depth-first search in a drawn order). Then some dead ends are opened.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from roslings_rover.models.drives.chance import Chance
from roslings_rover.models.rooms.furniture import track_between
from roslings_rover.models.rooms.room import FloorPlan, Place, Track
from roslings_rover.models.world import Box

Cell = tuple[int, int]
"""Column and row."""
COLUMNS, ROWS, PITCHES_M = (5, 6, 7), (4, 5), (1.2, 1.3, 1.4)
WALL_M = 0.1
OPENED = 0.6
"""Of the dead ends in which nothing moves."""
RADIUS_M, NEXT_TO_WALL_M = 0.15, 0.05
"""Of what moves, and of the floor between it and its walls."""
MOST_TRACKS = 2


@dataclass
class Maze:
    """Cells, and between which of them there is no wall."""

    columns: int
    rows: int
    pitch_m: float
    open: dict[Cell, list[Cell]] = field(default_factory=dict)

    @property
    def cells(self) -> list[Cell]:
        """All of them."""
        return [(column, row) for column in range(self.columns) for row in range(self.rows)]

    def beside(self, cell: Cell) -> list[Cell]:
        """The cells that share a side with one."""
        column, row = cell
        found = ((column + 1, row), (column, row + 1), (column - 1, row), (column, row - 1))
        return [(c, r) for c, r in found if 0 <= c < self.columns and 0 <= r < self.rows]

    def join(self, one: Cell, two: Cell) -> None:
        """Take the wall between two cells away."""
        self.open[one].append(two)
        self.open[two].append(one)

    def middle(self, cell: Cell) -> Place:
        """Of a cell, in metres."""
        return (cell[0] + 0.5) * self.pitch_m, (cell[1] + 0.5) * self.pitch_m

    @property
    def dead_ends(self) -> list[Cell]:
        """Cells with one way in."""
        return [cell for cell in self.cells if len(self.open[cell]) == 1]


def corridors(chance: Chance) -> FloorPlan:
    """The maze, its walls, and what moves; another one is drawn where nothing finds a track."""
    while True:
        maze = Maze(chance.pick(COLUMNS), chance.pick(ROWS), chance.pick(PITCHES_M))
        _span(maze, chance)
        homes = _homes(maze, chance)
        _open_dead_ends(maze, chance, homes)
        if tracks := tuple(_tracks(maze, homes, chance)):
            break
    inside = Box(0.0, 0.0, maze.columns * maze.pitch_m, maze.rows * maze.pitch_m)
    starts = tuple(map(maze.middle, chance.shuffled(maze.cells)))
    return FloorPlan(inside, tuple(_walls(maze)), tracks, starts)


def _span(maze: Maze, chance: Chance) -> None:
    """Join all cells to a tree."""
    maze.open = {cell: [] for cell in maze.cells}
    way = [chance.pick(maze.cells)]
    reached = {way[0]}
    while way:
        ahead = [cell for cell in maze.beside(way[-1]) if cell not in reached]
        if not ahead:
            way.pop()
            continue
        cell = chance.pick(ahead)
        maze.join(way[-1], cell)
        reached.add(cell)
        way.append(cell)


def _homes(maze: Maze, chance: Chance) -> list[Cell]:
    """Dead ends out of which something comes, each into another cell; a tree has two or more."""
    found: dict[Cell, Cell] = {}
    for cell in chance.shuffled(maze.dead_ends):
        found.setdefault(maze.open[cell][0], cell)
    return list(found.values())[: chance.pick(range(1, MOST_TRACKS + 1))]


def _open_dead_ends(maze: Maze, chance: Chance, but: list[Cell]) -> None:
    for cell in maze.dead_ends:
        behind = [c for c in maze.beside(cell) if c not in maze.open[cell] and c not in but]
        is_left = cell in but or len(maze.open[cell]) > 1  # another one was opened into it
        if not is_left and behind and chance.between(0, 1) < OPENED:
            maze.join(cell, chance.pick(behind))


def _tracks(maze: Maze, homes: list[Cell], chance: Chance) -> Iterator[Track]:
    """Out of each dead end, along a wall that goes on beside the cell before it."""
    for home in homes:
        before = maze.open[home][0]
        ahead = before[0] - home[0], before[1] - home[1]
        sides = [side for side in _beside(ahead) if _is_closed(maze, before, side)]
        if sides:
            yield _track(maze, home, ahead, chance.pick(sides), chance)


def _beside(ahead: Cell) -> tuple[Cell, Cell]:
    """One step to the left and to the right of a direction."""
    return (-ahead[1], ahead[0]), (ahead[1], -ahead[0])


def _is_closed(maze: Maze, cell: Cell, side: Cell) -> bool:
    return (cell[0] + side[0], cell[1] + side[1]) not in maze.open[cell]


def _track(maze: Maze, home: Cell, ahead: Cell, side: Cell, chance: Chance) -> Track:
    """From the end of a dead end to the middle of the cell before it, next to a wall."""
    off_m = maze.pitch_m / 2 - WALL_M / 2 - RADIUS_M - NEXT_TO_WALL_M
    middle_x, middle_y = maze.middle(home)
    x, y = middle_x + side[0] * off_m, middle_y + side[1] * off_m
    begin = round(x - ahead[0] * off_m, 3), round(y - ahead[1] * off_m, 3)
    turn = round(x + ahead[0] * maze.pitch_m, 3), round(y + ahead[1] * maze.pitch_m, 3)
    return track_between(begin, turn, RADIUS_M, chance)


def _walls(maze: Maze) -> Iterator[Box]:
    """Those between cells, each as long as it goes on."""
    pitch, half = maze.pitch_m, WALL_M / 2
    for column in range(1, maze.columns):
        closed = [(column - 1, row) not in maze.open[column, row] for row in range(maze.rows)]
        for first, last in _runs(closed):
            low_m, high_m = _ends(first, last, maze.rows, pitch)
            yield Box(column * pitch - half, low_m, column * pitch + half, high_m)
    for row in range(1, maze.rows):
        closed = [(column, row - 1) not in maze.open[column, row] for column in range(maze.columns)]
        for first, last in _runs(closed):
            low_m, high_m = _ends(first, last, maze.columns, pitch)
            yield Box(low_m, row * pitch - half, high_m, row * pitch + half)


def _ends(first: int, last: int, count: int, pitch_m: float) -> tuple[float, float]:
    """A wall goes half its thickness beyond its cells, but not beyond the room."""
    half = WALL_M / 2
    return max(first * pitch_m - half, 0.0), min(last * pitch_m + half, count * pitch_m)


def _runs(marks: list[bool]) -> Iterator[tuple[int, int]]:
    """Where marks follow each other: the first one, and the one behind the last."""
    begin = None
    for number, mark in enumerate([*marks, False]):
        if mark and begin is None:
            begin = number
        elif not mark and begin is not None:
            yield begin, number
            begin = None
