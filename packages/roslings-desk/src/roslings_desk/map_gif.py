"""The way of the robot over the last seconds, as a GIF of its map.

matplotlib draws it, as it does the rover's own pictures, and Pillow, which comes with it, writes
it. The desk does not bring them: they are half as large as all of it, and `./roslings rover` does.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from typing import Any

from roslings_rover.models.differential_drive import Body, Pose
from roslings_rover.models.world import World
from roslings_rover.rover.picture import PATH, draw_body, draw_moving, draw_world
from roslings_rover.rover.rover import RoverMoment

FRAME_S = 0.25
LAST_FRAME_S = 2.0
"""The end stands longer, before the way begins again."""
INCHES, DOTS_PER_INCH = (4.6, 4.2), 100


def can_draw() -> bool:
    """Whether all that it needs is installed."""
    return find_spec("matplotlib") is not None and find_spec("PIL") is not None


def gif_of(way: Sequence[RoverMoment], world: World) -> bytes:
    """A GIF of the way, in real time, again and again; `way` has one moment at least.

    What moves in the world stands where it is in the end.
    """
    frames = list(_frames(list(_steps(way)), world))
    shown_ms = [round(FRAME_S * 1000)] * (len(frames) - 1) + [round(LAST_FRAME_S * 1000)]
    file = io.BytesIO()
    frames[0].save(
        file, format="GIF", save_all=True, append_images=frames[1:], duration=shown_ms, loop=0
    )
    return file.getvalue()


def _steps(way: Sequence[RoverMoment]) -> Iterator[Pose]:
    """Where it was at the moment of each frame."""
    shown_s = way[0].time_s
    for before, after in zip(way, [*way[1:], None], strict=True):
        while after is None or shown_s < after.time_s:
            yield before.pose
            shown_s += FRAME_S
            if after is None:
                return


def _frames(poses: list[Pose], world: World) -> Iterator[Any]:
    """A Pillow image each. What does not move is drawn once."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image

    figure = Figure(figsize=INCHES, dpi=DOTS_PER_INCH, layout="constrained")
    canvas: Any = FigureCanvasAgg(figure)  # matplotlib has no types for it
    axes: Any = figure.add_subplot()
    draw_world(world, axes)
    draw_moving(world, axes)
    canvas.draw()
    still = canvas.copy_from_bbox(figure.bbox)
    (line,) = axes.plot([], [], color=PATH)
    for number, pose in enumerate(poses, start=1):
        canvas.restore_region(still)
        line.set_data([p.x_m for p in poses[:number]], [p.y_m for p in poses[:number]])
        moving = [line, *draw_body(pose, Body().radius_m, axes)]
        for artist in moving:
            axes.draw_artist(artist)
        for artist in moving[1:]:
            artist.remove()
        picture = Image.frombytes("RGBA", canvas.get_width_height(), bytes(canvas.buffer_rgba()))
        yield picture.convert("RGB").quantize(64)
