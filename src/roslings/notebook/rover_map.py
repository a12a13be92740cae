"""The rover's map below a cell: where it is now, or which way it went."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from roslings.notebook.picture import Picture, show
from roslings.notebook.trouble import Trouble

if TYPE_CHECKING:
    from roslings.devices.rover.notebook import LiveRover

SIZE_IN = (5.6, 5.1)
PATH_COLOUR = "#1f6feb"


class NoWay(Trouble):
    """A drive needs places."""

    def __init__(self) -> None:
        super().__init__(
            "There is no place to draw. Give odometry: show_path(ros.collect('/odom', count=20))"
        )


def show_map(rover: LiveRover) -> None:
    """Show the map of the rover that `ros.rover()` gave, with its path until now."""
    pose = rover.pose
    degrees = math.degrees(pose.heading_rad)
    alt = (
        f"The rover's map. It is at x {pose.x_m:.2f} m, y {pose.y_m:.2f} m,"
        f" heading {degrees:.0f} degrees."
    )
    show(Picture(rover.picture(), "image/png", alt))


def show_path(odometry: Sequence[Any]) -> None:
    """Show the drive that a list of nav_msgs/Odometry tells, on the rover's map.

    Also takes what `collect(..., stamps=True)` gave. Raises NoWay.
    """
    messages = [getattr(each, "message", each) for each in odometry]
    places = [(each.pose.pose.position.x, each.pose.pose.position.y) for each in messages]
    if not places:
        raise NoWay
    show(Picture(_drawn(places), "image/png", _in_words(places)))


def _in_words(places: Sequence[tuple[float, float]]) -> str:
    (x0, y0), (x1, y1) = places[0], places[-1]
    way_m = sum(math.dist(a, b) for a, b in pairwise(places))
    return (
        f"A drive on the rover's map, {way_m:.2f} m long in {len(places)} places:"
        f" from x {x0:.2f} m, y {y0:.2f} m to x {x1:.2f} m, y {y1:.2f} m."
    )


def _drawn(places: Sequence[tuple[float, float]]) -> bytes:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from roslings.devices.rover.picture import draw_world, name_what_is_drawn
    from roslings.devices.rover.world import default_world

    figure = Figure(figsize=SIZE_IN, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    draw_world(default_world(), axes)
    xs, ys = [x for x, _ in places], [y for _, y in places]
    axes.plot(xs, ys, ".-", color=PATH_COLOUR, label="path", zorder=5)
    axes.plot(xs[:1], ys[:1], "o", color=PATH_COLOUR, label="start", zorder=5)
    axes.plot(xs[-1:], ys[-1:], "s", color="#0b2f6b", label="end", zorder=5)
    name_what_is_drawn(axes)
    file = io.BytesIO()
    figure.savefig(file, format="png")
    return file.getvalue()
