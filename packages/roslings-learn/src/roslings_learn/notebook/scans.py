"""What scans saw, and a map of cells, as pictures below a cell."""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Iterator, Sequence
from itertools import chain
from typing import Any

from roslings_learn.notebook.errors import NotebookTrouble
from roslings_learn.notebook.picture import NotebookPicture, show
from roslings_learn.notebook.rover_map import pose_of
from roslings_rover.palette import colour_of

Point = tuple[float, float]
WIDE_IN, HIGH_IN, DOTS_PER_INCH = 3.6, 3.6, 100
"""Inches of one picture; two stand side by side."""
COLOURS = 64
"""A page with six such pictures stays small."""
DOT_POINTS = 2.0
OCCUPIED = 50
"""From here on a cell is drawn as occupied, as RViz does."""


class NoScans(NotebookTrouble):
    """Nothing to draw."""

    def __init__(self) -> None:
        super().__init__("There is no scan to draw. Give some: ros.collect('/scan', count=6)")


class PlacesMissing(NotebookTrouble):
    """Each scan was measured somewhere."""

    def __init__(self, scans: int, places: int) -> None:
        super().__init__(f"{scans} scans need {scans} places, and there are {places}.")


class UnfilledGrid(NotebookTrouble):
    """The cells do not fill the rows."""

    def __init__(self, wide: int, high: int, cells: int) -> None:
        super().__init__(
            f"A map of {wide} by {high} needs {wide * high} cells in data, and it has {cells}."
        )


def show_scans(scans: Sequence[Any], places: Sequence[Any] = ()) -> None:
    """Show the points of several sensor_msgs/LaserScan, each scan in a colour of its own.

    They lie as if the laser had not moved. `places` are TransformStamped, one for each scan: where
    the laser was. Then a second picture shows the points there. Raises NoScans and PlacesMissing.
    """
    show(scans_picture(scans, places))


def scans_picture(scans: Sequence[Any], places: Sequence[Any] = ()) -> NotebookPicture:
    """The picture that `show_scans` shows. Raises NoScans and PlacesMissing."""
    if not scans:
        raise NoScans
    if places and len(places) != len(scans):
        raise PlacesMissing(len(scans), len(places))
    alone = [list(points_of(scan)) for scan in scans]
    drawn = {"by the laser's numbers alone": alone}
    if places:
        moved = [_moved(points, place) for points, place in zip(alone, places, strict=True)]
        drawn[f"in the frame {places[0].header.frame_id}"] = moved
    told = (f"{title.capitalize()}: {_extent(points)}." for title, points in drawn.items())
    alt = f"The points of {len(scans)} scans from above, in metres. {' '.join(told)}"
    return NotebookPicture(_drawn(drawn), "image/png", alt)


def points_of(scan: Any) -> Iterator[Point]:
    """Where something was seen, x ahead of the laser and y to its left, in metres."""
    for index, distance_m in enumerate(scan.ranges):
        if scan.range_min <= distance_m <= scan.range_max:
            angle = scan.angle_min + index * scan.angle_increment
            yield distance_m * math.cos(angle), distance_m * math.sin(angle)


def _moved(points: Sequence[Point], place: Any) -> list[Point]:
    """From the frame that lies there, on flat ground, to the one of the header."""
    laser = pose_of(place.transform.translation, place.transform.rotation)
    return [laser.ahead(x, y) for x, y in points]


def _extent(scans: Sequence[Sequence[Point]]) -> str:
    points = list(chain.from_iterable(scans))
    if not points:
        return "nothing is seen"
    xs, ys = zip(*points, strict=True)
    return f"x from {min(xs):.1f} to {max(xs):.1f}, y from {min(ys):.1f} to {max(ys):.1f}"


def _drawn(pictures: dict[str, list[list[Point]]]) -> bytes:
    def draw(axes: Sequence[Any]) -> None:
        for each, (title, scans) in zip(axes, pictures.items(), strict=True):
            _axes(each, title)
            each.plot(0, 0, "+", color=colour_of("soft"), markersize=9)
            for number, points in enumerate(scans):
                _scan(each, points, number / max(1, len(scans) - 1))

    return _png(len(pictures), draw)


def _scan(axes: Any, points: Sequence[Point], late: float) -> None:
    """The first scan is blue, the last one is red."""
    colour = (0.12 + 0.6 * late, 0.36 - 0.22 * late, 0.80 - 0.65 * late)
    if points:
        axes.plot(*zip(*points, strict=True), ".", color=colour, markersize=DOT_POINTS)


def _axes(axes: Any, title: str) -> None:
    axes.set_title(title, fontsize=10)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("x in m")
    axes.set_ylabel("y in m")
    axes.grid(color=colour_of("grid"))


def _png(count: int, draw: Callable[[Sequence[Any]], None]) -> bytes:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image

    figure = Figure(figsize=(WIDE_IN * count, HIGH_IN), layout="constrained")
    FigureCanvasAgg(figure)
    draw([figure.add_subplot(1, count, number + 1) for number in range(count)])
    large, small = io.BytesIO(), io.BytesIO()
    figure.savefig(large, format="png", dpi=DOTS_PER_INCH)
    Image.open(large).convert("RGB").quantize(COLOURS).save(small, "PNG", optimize=True)
    return small.getvalue()


# --- a map of cells ------------------------------------------------------------------------------


def show_grid(grid: Any) -> None:
    """Show a nav_msgs/OccupancyGrid: black is occupied, white free, grey unknown.

    Raises UnfilledGrid.
    """
    show(grid_picture(grid))


def grid_picture(grid: Any) -> NotebookPicture:
    """The picture that `show_grid` shows. Raises UnfilledGrid."""
    wide, high, cells = grid.info.width, grid.info.height, list(grid.data)
    if not cells or len(cells) != wide * high:
        raise UnfilledGrid(wide, high, len(cells))
    occupied, unknown = sum(cell >= OCCUPIED for cell in cells), sum(cell < 0 for cell in cells)
    free = len(cells) - occupied - unknown
    alt = (
        f"A map of {high} rows and {wide} columns: {occupied} cells are occupied, {free} free and"
        f" {unknown} unknown."
    )
    return NotebookPicture(_grid(grid, cells), "image/png", alt)


def _grid(grid: Any, cells: Sequence[int]) -> bytes:
    wide, high, size_m = grid.info.width, grid.info.height, grid.info.resolution
    left, low = grid.info.origin.position.x, grid.info.origin.position.y
    grey = [[_shade(cell) for cell in cells[at : at + wide]] for at in range(0, wide * high, wide)]

    def draw(axes: Sequence[Any]) -> None:
        _axes(axes[0], f"in the frame {grid.header.frame_id}")
        edges = (left, left + wide * size_m, low, low + high * size_m)
        axes[0].imshow(grey, cmap="gray", vmin=0, vmax=1, origin="lower", extent=edges)
        axes[0].grid(visible=False)

    return _png(1, draw)


def _shade(cell: int) -> float:
    """0 is black, and 1 is white."""
    return 0.75 if cell < 0 else 1 - min(cell, 100) / 100
