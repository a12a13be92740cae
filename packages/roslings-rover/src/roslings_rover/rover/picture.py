"""The rover's map and path, drawn by matplotlib."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.rooms import moving_in
from roslings_rover.models.world import Ball, Box, Circle, World
from roslings_rover.rover.rover import Rover

WALL, OBSTACLE, PATH, ROVER = "#444444", "#b8b8b8", "#1f77b4", "#0b2f6b"
MOVING = "#c2571a"
DRAWN = "#2e7d32"
"""Walls that somebody has drawn."""
DOTS_PER_INCH = 100


def draw(rover: Rover, axes: Any) -> None:
    """Draw the world, the path and the rover into matplotlib axes; units are metres."""
    draw_world(rover.world, axes)
    axes.plot([p.x_m for p in rover.path], [p.y_m for p in rover.path], color=PATH, label="path")
    start = rover.path[0]
    axes.plot([start.x_m], [start.y_m], "o", color=PATH, markersize=4, label="start")
    draw_rover(rover, axes)
    draw_moving(rover.world, axes)
    name_what_is_drawn(axes)


def name_what_is_drawn(axes: Any) -> None:
    """A legend above the room, so that it hides nothing of it."""
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=4, frameon=False)


def draw_world(world: World, axes: Any) -> None:
    """Draw what does not move."""
    room = world.room
    axes.set_xlim(room.west_m - 0.3, room.east_m + 0.3)
    axes.set_ylim(room.south_m - 0.3, room.north_m + 0.3)
    axes.set_aspect("equal")
    axes.set_xlabel("x in m")
    axes.set_ylabel("y in m")
    axes.grid(visible=True, color="#eeeeee", zorder=0)
    axes.set_axisbelow(True)
    axes.add_patch(_box(room, fill=False, edgecolor=WALL, linewidth=3))
    for shape in world.obstacles:
        axes.add_patch(_patch(shape))
    for ball in world.balls:
        axes.add_patch(_ball(ball))
        axes.plot([], [], "o", color=_colour(ball), label="ball")  # for the legend


def draw_moving(world: World, axes: Any) -> list[Any]:
    """Draw what moves, where it is now; returns what can be removed again."""
    from matplotlib.patches import Circle as Disc

    return [
        axes.add_patch(Disc((each.x_m, each.y_m), each.radius_m, facecolor=MOVING, edgecolor=WALL))
        for each in moving_in(world)
    ]


def draw_rover(rover: Rover, axes: Any, colour: str = ROVER) -> list[Any]:
    """Draw the rover, with a line that shows where it looks; returns what can be removed again."""
    return draw_body(rover.pose, rover.body.radius_m, axes, colour)


def draw_body(pose: Pose, radius_m: float, axes: Any, colour: str = ROVER) -> list[Any]:
    """The same of a rover that is somewhere."""
    from matplotlib.patches import Circle as Disc

    nose_x, nose_y = pose.ahead(2 * radius_m)
    disc = axes.add_patch(Disc((pose.x_m, pose.y_m), radius_m, color=colour, zorder=4))
    nose = axes.plot([pose.x_m, nose_x], [pose.y_m, nose_y], color=colour, linewidth=3, zorder=4)
    return [disc, *nose]


def save(rover: Rover, file: Path, title: str = "The rover's path") -> None:
    """Write the map as a picture; the file's ending names the format. Raises OSError."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 6.5), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.set_title(title)
    draw(rover, axes)
    figure.savefig(file, dpi=DOTS_PER_INCH)


def _patch(shape: Circle | Box) -> Any:
    from matplotlib.patches import Circle as Disc

    if isinstance(shape, Box):
        return _box(shape, facecolor=OBSTACLE, edgecolor=WALL)
    return Disc((shape.x_m, shape.y_m), shape.radius_m, facecolor=OBSTACLE, edgecolor=WALL)


def _box(box: Box, **style: Any) -> Any:
    from matplotlib.patches import Rectangle

    wide_m, high_m = box.east_m - box.west_m, box.north_m - box.south_m
    return Rectangle((box.west_m, box.south_m), wide_m, high_m, **style)


def _ball(ball: Ball) -> Any:
    from matplotlib.patches import Circle as Disc

    return Disc((ball.x_m, ball.y_m), ball.radius_m, color=_colour(ball), zorder=3)


def _colour(ball: Ball) -> Any:
    from matplotlib.colors import hsv_to_rgb

    return hsv_to_rgb((ball.hue / 180, 0.9, 0.9))


def describe(rover: Rover) -> str:
    """Where the rover is, in one line."""
    pose = rover.pose
    degrees = math.degrees(pose.heading_rad)
    return f"x {pose.x_m:.2f} m, y {pose.y_m:.2f} m, heading {degrees:.0f} degrees"
