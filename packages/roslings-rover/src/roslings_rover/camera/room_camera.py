"""The camera in a room: it draws the walls and what stands and moves before it, and the balls.

There is one ray a column (as in Wolfenstein 3D, 1992). All but the walls is equally high, and
higher than the camera. So in each column the nearest thing hides the others.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from roslings_rover.camera.camera import CameraMount, SyntheticCamera
from roslings_rover.camera.frame import Frame, Pixels, frame_of
from roslings_rover.camera.scene import WALL_RGB, background, draw
from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.pinhole import Disc, PinholeCameraModel
from roslings_rover.models.rooms import moving_in
from roslings_rover.models.shape_arrays import (
    Hits,
    Numbers,
    Rays,
    apart_by_kind,
    box_hits,
    circle_hits,
    wall_hits,
)
from roslings_rover.models.world import World

BOX_RGB, ROUND_RGB, MOVING_RGB = (116, 128, 146), (104, 130, 116), (146, 116, 150)
"""Pale: no search for a ball's colour finds them."""
THING_HIGH_M = 0.5
"""Of boxes and round things. The room's own walls go up as far as one sees."""
ALONG_Y = 0.86
"""A face that looks along y is so much darker: where two faces meet, one sees an edge."""
DARKEST, FAR_DARKER, FAR_M = 0.6, 0.25, 8.0
NEAREST_M = 0.02
"""Of what is nearer, or around the camera, one sees no more than of this."""


@dataclass(frozen=True)
class Columns:
    """What each column of the picture shows of some things."""

    depth_m: Numbers
    """Along the camera's axis; infinity where there is nothing."""
    rgb: npt.NDArray[np.uint8]
    """One colour each."""


Packed = npt.NDArray[np.uint32]
"""Pixels of four bytes, the last of which means nothing: one is written in one step."""


class RoomCamera(SyntheticCamera):
    """Draws what stands in the room, too."""

    def look(self, rover: CameraMount) -> Frame:
        """What the rover sees now."""
        discs = [self._coloured(disc) for disc in self.camera_model.see(rover.world, rover.pose)]
        picture = drawn(self.camera_model, rover.world, rover.pose)
        if discs:
            _put_balls(picture, discs)
        return frame_of(self._lit(picture), self.encoding, self.idle_bytes)


def drawn(camera_model: PinholeCameraModel, world: World, pose: Pose) -> Pixels:
    """The room before the camera, without balls: rows, columns and (red, green, blue)."""
    here = camera_model.place(pose)
    off_px = (camera_model.width_px - 1) / 2 - np.arange(camera_model.width_px)
    off_rad = np.arctan2(off_px, camera_model.focal_px)
    rays = Rays.towards(here.x_m, here.y_m, here.heading_rad + off_rad)
    along = np.cos(off_rad)
    packed = _background(camera_model.width_px, camera_model.height_px).copy()
    _put(packed, camera_model, _columns(wall_hits(world.room, rays), along, WALL_RGB), np.inf)
    things = _nearest([_columns(hits, along, rgb) for hits, rgb in _things(world, rays)])
    _put(packed, camera_model, things, THING_HIGH_M)
    four: Pixels = packed.view(np.uint8).reshape(*packed.shape, 4)
    return np.ascontiguousarray(four[:, :, :3])


@lru_cache(maxsize=4)
def _background(width: int, height: int) -> Packed:
    return _packed(background(width, height))


def _packed(rgb: Pixels) -> Packed:
    four = np.zeros((*rgb.shape[:-1], 4), np.uint8)
    four[..., :3] = rgb
    packed: Packed = four.view(np.uint32)[..., 0]
    return packed


def _things(world: World, rays: Rays) -> Iterator[tuple[Hits, tuple[int, int, int]]]:
    boxes, circles = apart_by_kind(world.obstacles)
    yield box_hits(boxes, rays), BOX_RGB
    yield circle_hits(circles, rays), ROUND_RGB
    yield circle_hits(moving_in(world), rays), MOVING_RGB


def _columns(hits: Hits, along: Numbers, rgb: tuple[int, int, int]) -> Columns:
    """Brighter where it is hit squarely, and where it is near."""
    light = DARKEST + (1 - DARKEST) * hits.facing
    light = np.where(hits.on_x, light, light * ALONG_Y)
    light *= 1 - FAR_DARKER * np.minimum(hits.distance_m, FAR_M) / FAR_M
    shade = (np.array(rgb) * light[:, None] + 0.5).astype(np.uint8)
    return Columns(np.maximum(hits.distance_m, NEAREST_M) * along, shade)


def _nearest(found: list[Columns]) -> Columns:
    depths = np.array([each.depth_m for each in found])
    first, each = depths.argmin(axis=0), np.arange(depths.shape[1])
    return Columns(depths[first, each], np.array([one.rgb for one in found])[first, each])


def _put(
    picture: Packed, camera_model: PinholeCameraModel, columns: Columns, high_m: float
) -> None:
    """Fill each column from the upper edge of what it shows to where that stands on the floor."""
    rows = np.arange(camera_model.height_px)[:, None]
    below_px = camera_model.focal_px * camera_model.height_m / columns.depth_m
    above_px = camera_model.focal_px * (high_m - camera_model.height_m) / columns.depth_m
    there = np.isfinite(columns.depth_m)
    filled = (
        (rows <= camera_model.horizon_px + below_px)
        & (rows >= camera_model.horizon_px - above_px)
        & there
    )
    np.copyto(picture, _packed(columns.rgb), where=filled)


def _put_balls(picture: Pixels, discs: list[Disc]) -> None:
    """As the usual camera draws them, over what is there."""
    height, width, _ = picture.shape
    balls = draw(discs, width, height)
    covered = (balls != background(width, height)).any(axis=2)
    picture[covered] = balls[covered]
