"""Draws what is before the camera: a wall, a floor, and balls on it."""

from __future__ import annotations

import colorsys
import math
from collections.abc import Iterable
from functools import lru_cache

import numpy as np

from roslings_rover.camera.frame import Pixels
from roslings_rover.models.pinhole import Disc

WALL_RGB = (176, 180, 184)
NEAR_FLOOR_RGB, FAR_FLOOR_RGB = (112, 108, 102), (150, 146, 140)
SATURATION, DARKEST, BRIGHTEST = 0.85, 0.45, 0.95
HUES = 180
"""OpenCV counts a colour's hue in steps of two degrees."""


def draw(discs: Iterable[Disc], width: int, height: int) -> Pixels:
    """The picture as rows, columns and (red, green, blue); the last disc is on top."""
    picture: Pixels = background(width, height).copy()
    for disc in discs:
        _draw_ball(picture, disc)
    return picture


@lru_cache(maxsize=4)
def background(width: int, height: int) -> Pixels:
    """The wall above the horizon, and the floor below it, lighter far away. Not to be changed."""
    rows = np.empty((height, 1, 3), np.uint8)
    horizon = height // 2
    rows[:horizon] = WALL_RGB
    nearness = np.linspace(0.0, 1.0, max(1, height - horizon))[:, None, None]
    far, near = np.array(FAR_FLOOR_RGB), np.array(NEAR_FLOOR_RGB)
    rows[horizon:] = (far + (near - far) * nearness).astype(np.uint8)
    picture = np.ascontiguousarray(np.broadcast_to(rows, (height, width, 3)))
    picture.setflags(write=False)
    return picture


def _draw_ball(picture: Pixels, disc: Disc) -> None:
    """A ball lit from above on the left; its rim is mixed with what lies behind it.

    The shade at a point is that of a sphere by Lambert's law: the part of the light that falls
    along the surface's normal.
    """
    height, width, _ = picture.shape
    top, bottom = _span(disc.v_px, disc.radius_px, height)
    left, right = _span(disc.u_px, disc.radius_px, width)
    if top >= bottom or left >= right:
        return
    y = (np.arange(top, bottom)[:, None] - disc.v_px) / disc.radius_px
    x = (np.arange(left, right)[None, :] - disc.u_px) / disc.radius_px
    away = np.hypot(x, y)
    covers = np.clip((1.0 - away) * disc.radius_px + 0.5, 0.0, 1.0)[:, :, None]
    toward = np.sqrt(np.clip(1.0 - away**2, 0.0, 1.0))
    lit = np.clip(-0.35 * x - 0.5 * y + 0.79 * toward, 0.0, 1.0)[:, :, None]
    colour = np.array(colorsys.hsv_to_rgb(disc.hue / HUES, SATURATION, 1.0)) * 255
    ball = colour * (DARKEST + (BRIGHTEST - DARKEST) * lit)
    behind = picture[top:bottom, left:right]
    picture[top:bottom, left:right] = (behind + (ball - behind) * covers + 0.5).astype(np.uint8)


def _span(middle_px: float, radius_px: float, size: int) -> tuple[int, int]:
    """The rows or columns that a disc touches, cut at the picture's edge."""
    first, last = math.floor(middle_px - radius_px) - 1, math.ceil(middle_px + radius_px) + 2
    return max(0, first), min(size, last)
