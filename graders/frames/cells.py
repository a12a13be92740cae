"""How much of a map is right, and which mistake puts its walls elsewhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graders.frames.drive import Drive, Numbers, Scan
from graders.frames.places import points_of
from graders.frames.record import MapSeen, MapSlip

Cells = NDArray[np.int64]
"""Column and row of each, counted from the cell at (0, 0)."""

Grid = NDArray[np.bool_]
MIN_CELL_M, MAX_CELL_M = 0.02, 0.5
"""Cells of another size are not looked at: too many, or too few."""

REACH_M = 6.0
"""What lies farther away is not looked at."""

THROUGH = 3
"""So many samples of beams lie in a cell, where it counts as free."""

SAMPLE_CELLS = 0.25
"""Of a beam, so many cells apart."""

LOOKED_INTO, EXPLAINS, CLEARLY = 0.95, 0.85, 0.05
"""Where less of the walls is right, a mistake is looked for. So much of them it must explain, and
clearly more than is right anyway."""

LETTERS = {100: "#", 0: ".", -1: " "}
SHOWN = 120
"""Rows and columns of the picture, around the place where the rover began."""


@dataclass(frozen=True)
class MapTruth:
    """What a whole drive has shown, in cells around (0, 0)."""

    cell_m: float
    walls: Cells
    hit: Grid
    through: Grid
    never: Grid

    @property
    def reach(self) -> int:
        """Cells from (0, 0) to the edge."""
        return len(self.hit) // 2


def truth_of(drive: Drive, cell_m: float) -> MapTruth:
    """Of the scans whose place can be known."""
    reach = round(REACH_M / cell_m)
    hit, through, endless = (np.zeros((2 * reach, 2 * reach), int) for _ in range(3))
    places = []
    for scan in drive.scans:
        if scan.part in ("standing", "moving"):
            points = points_of(drive, scan, scan.laser)
            places.append(points)
            _count(hit, _cells(points, cell_m), reach)
            _count(through, _cells(_along(scan, points, cell_m), cell_m), reach)
            _count(endless, _cells(_along(scan, _ends(drive, scan), cell_m), cell_m), reach)
    near_hit = _grown(hit > 0)
    return MapTruth(
        cell_m=cell_m,
        walls=np.unique(_cells(np.vstack(places), cell_m), axis=0),
        hit=hit > 0,
        through=(through >= THROUGH) & ~near_hit,
        never=~_grown(_grown((hit > 0) | (through > 0) | (endless > 0))),
    )


def _ends(drive: Drive, scan: Scan) -> Numbers:
    """Where beams that are no distances would end, at most."""
    far = Scan(
        scan.at_s,
        scan.comes_s,
        scan.laser,
        scan.turn_rad_s,
        scan.part,
        np.where(scan.is_distance, np.nan, 4.0),
    )
    return points_of(drive, far, scan.laser)


def _along(scan: Scan, ends: Numbers, cell_m: float) -> Numbers:
    """Places on the way from the laser to each end."""
    start = np.array([scan.laser.x_m, scan.laser.y_m])
    samples = round(4.0 / cell_m / SAMPLE_CELLS)
    lengths = np.hypot(*(ends - start).T)
    part = np.arange(samples)[None, :] * cell_m * SAMPLE_CELLS / np.maximum(lengths, 1e-9)[:, None]
    places = start + part[..., None] * (ends - start)[:, None, :]
    found: Numbers = places[part < 1.0]
    return found


def _cells(points: Numbers, cell_m: float) -> Cells:
    cells: Cells = np.floor(points / cell_m).astype(np.int64)
    return cells


def _count(grid: NDArray[Any], cells: Cells, reach: int) -> None:
    inside = cells[(np.abs(cells + 0.5) < reach).all(axis=1)] + reach
    np.add.at(grid, (inside[:, 1], inside[:, 0]), 1)


def _grown(grid: Grid) -> Grid:
    """With all that lies beside."""
    padded = np.pad(grid, 1)
    rows, columns = grid.shape
    grown: Grid = np.logical_or.reduce(
        [padded[y : y + rows, x : x + columns] for y in range(3) for x in range(3)]
    )
    return grown


def measured(drive: Drive, seen: MapSeen, values: NDArray[np.int8]) -> tuple[MapSeen, str]:
    """The map with the parts of it that are right, and a picture of its middle."""
    if not MIN_CELL_M <= seen.cell_m <= MAX_CELL_M or seen.width * seen.height != len(values):
        return seen, ""
    truth = truth_of(drive, seen.cell_m)
    told = _around_zero(seen, values.reshape(seen.height, seen.width), truth.reach)
    wall = told == 100
    right = _share(wall, truth.hit)
    judged = seen.model_copy(
        update={
            "walls": right,
            "true_walls": _share(_grown(truth.hit), wall),
            "free": _share(told == 0, truth.through),
            "unknown": _share(told == -1, truth.never),
            "like": _slip(truth, wall, seen, right) if right < LOOKED_INTO else "",
        }
    )
    return judged, _shown(told, truth.reach)


def _around_zero(seen: MapSeen, values: NDArray[np.int8], reach: int) -> NDArray[np.int8]:
    """The same cells, counted from (0, 0); what the map has not is unknown."""
    told = np.full((2 * reach, 2 * reach), -1, np.int8)
    left, low = (round(each / seen.cell_m) + reach for each in (seen.x_m, seen.y_m))
    rows = slice(max(0, low), min(2 * reach, low + seen.height))
    columns = slice(max(0, left), min(2 * reach, left + seen.width))
    if rows.start < rows.stop and columns.start < columns.stop:
        part = values[rows.start - low : rows.stop - low, columns.start - left :]
        told[rows, columns] = part[:, : columns.stop - columns.start]
    return told


def _share(of: Grid, among: Grid) -> float:
    """The part of `among` that is also in `of`; none where there is nothing."""
    count = int(among.sum())
    return round(float((of & among).sum()) / count, 3) if count else 0.0


def _slip(truth: MapTruth, wall: Grid, seen: MapSeen, right: float) -> MapSlip:
    """The mistake that explains best where the walls are."""
    cut = np.zeros_like(wall, int)
    _count(cut, truth.walls + (truth.walls < 0), truth.reach)
    shifts = [(x, y) for x in range(-3, 4) for y in range(-3, 4)]
    guesses: dict[MapSlip, float] = {
        "": max(right + CLEARLY, EXPLAINS),
        "rows_and_columns": _share(_transposed(wall, truth, seen), truth.hit),
        "cut_towards_zero": _share(wall, cut > 0),
        "elsewhere": max(_share(np.roll(wall, each, (0, 1)), truth.hit) for each in shifts),
    }
    return max(guesses, key=lambda slip: guesses[slip])


def _transposed(wall: Grid, truth: MapTruth, seen: MapSeen) -> Grid:
    """As if rows had been columns, within the map that there is."""
    left, low = (round(each / seen.cell_m) + truth.reach for each in (seen.x_m, seen.y_m))
    turned = np.zeros_like(wall)
    rows, columns = np.nonzero(wall)
    rows, columns = columns - left + low, rows - low + left
    inside = (rows >= 0) & (columns >= 0) & (rows < len(wall)) & (columns < len(wall))
    turned[rows[inside], columns[inside]] = True
    return turned


def _shown(told: NDArray[np.int8], reach: int) -> str:
    """Its middle, row by row from the north."""
    half = min(reach, SHOWN // 2)
    middle = told[reach - half : reach + half, reach - half : reach + half][::-1]
    return "\n".join("".join(LETTERS.get(int(cell), "?") for cell in row) for row in middle)
