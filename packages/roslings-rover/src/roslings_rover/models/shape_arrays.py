"""Rays against many shapes at once, by numpy: what `World.distance` says of one ray, of all.

Each axis has arrays of its own, for shapes times rays. A box is hit where a ray is between west and
east and between south and north at once. Source: the slab method, T. Kay and J. Kajiya, "Ray
Tracing Complex Scenes", SIGGRAPH 1986.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roslings_rover.models.world import Box, Circle, World

PARALLEL = 1e-12
"""Below this slope a ray never leaves its row or column."""

Numbers = NDArray[np.floating[Any]]


@dataclass(frozen=True)
class Rays:
    """Rays from one place, in as many directions."""

    x_m: float
    y_m: float
    cos: Numbers
    sin: Numbers

    @classmethod
    def towards(cls, x_m: float, y_m: float, angles_rad: Numbers) -> Rays:
        """One for each angle."""
        return cls(x_m, y_m, np.cos(angles_rad), np.sin(angles_rad))


@dataclass(frozen=True)
class Hits:
    """What each ray hits first of some shapes."""

    distance_m: Numbers
    """Infinity where it misses all."""
    facing: Numbers
    """How squarely it hits: 1 head-on, 0 along the surface."""
    on_x: NDArray[np.bool_]
    """It hits a face that looks along x; a round thing has none."""


def distances(world: World, rays: Rays) -> Numbers:
    """How far one can look along each ray, in metres; the room's walls end it."""
    boxes, circles = apart_by_kind(world.shapes)
    nearest = np.minimum(*_to_the_walls(world.room, rays))
    if boxes:
        nearest = np.minimum(nearest, _into_boxes(boxes, rays)[0].min(axis=0))
    if circles:
        nearest = np.minimum(nearest, _into_circles(circles, rays)[0].min(axis=0))
    return np.maximum(nearest, 0.0)


def gaps(shapes: Sequence[Circle | Box], x_m: Numbers, y_m: Numbers) -> Numbers:
    """How far each place is from the nearest shape; negative inside, infinity without shapes."""
    boxes, circles = apart_by_kind(shapes)
    nearest = np.full(np.broadcast(x_m, y_m).shape, np.inf)
    for box in boxes:
        off_x = np.maximum(box.west_m - x_m, x_m - box.east_m)
        off_y = np.maximum(box.south_m - y_m, y_m - box.north_m)
        outside = np.hypot(np.maximum(off_x, 0.0), np.maximum(off_y, 0.0))
        gap = np.where(outside > 0, outside, np.maximum(off_x, off_y))
        np.minimum(nearest, gap, out=nearest)
    for circle in circles:
        gap = np.hypot(x_m - circle.x_m, y_m - circle.y_m) - circle.radius_m
        np.minimum(nearest, gap, out=nearest)
    return nearest


def apart_by_kind(shapes: Sequence[Circle | Box]) -> tuple[list[Box], list[Circle]]:
    """The boxes, and the round ones."""
    boxes = [each for each in shapes if isinstance(each, Box)]
    return boxes, [each for each in shapes if isinstance(each, Circle)]


def box_hits(boxes: Sequence[Box], rays: Rays) -> Hits:
    """What each ray hits first of some boxes; from inside of one its distance is 0."""
    if not boxes:
        return _missed(rays)
    enters, on_x = _into_boxes(boxes, rays)
    first, each = enters.argmin(axis=0), np.arange(rays.cos.size)
    on_x = on_x[first, each]
    return Hits(enters[first, each], np.abs(np.where(on_x, rays.cos, rays.sin)), on_x)


def circle_hits(circles: Sequence[Circle], rays: Rays) -> Hits:
    """What each ray hits first of some round things; from inside of one its distance is 0."""
    if not circles:
        return _missed(rays)
    enters, facing = _into_circles(circles, rays)
    first, each = enters.argmin(axis=0), np.arange(rays.cos.size)
    return Hits(enters[first, each], facing[first, each], np.zeros(each.size, np.bool_))


def wall_hits(room: Box, rays: Rays) -> Hits:
    """The walls of a room, from inside of it."""
    far_x, far_y = _to_the_walls(room, rays)
    on_x = far_x < far_y
    facing = np.abs(np.where(on_x, rays.cos, rays.sin))
    return Hits(np.maximum(np.minimum(far_x, far_y), 0.0), facing, on_x)


def _missed(rays: Rays) -> Hits:
    count = rays.cos.size
    return Hits(np.full(count, np.inf), np.zeros(count), np.zeros(count, np.bool_))


def _into_boxes(boxes: Sequence[Box], rays: Rays) -> tuple[Numbers, NDArray[np.bool_]]:
    """For boxes times rays: how far it is, infinity for a miss; and whether that face is on x."""
    west, east, south, north = np.array(
        [(b.west_m, b.east_m, b.south_m, b.north_m) for b in boxes]
    ).T[:, :, None]
    near_x, far_x = _spans(rays.x_m, rays.cos, west, east)
    near_y, far_y = _spans(rays.y_m, rays.sin, south, north)
    on_x = near_x > near_y
    enters = np.maximum(near_x, near_y, out=near_x)
    np.maximum(enters, 0.0, out=enters)
    misses = np.minimum(far_x, far_y, out=far_x) < enters
    np.copyto(enters, np.inf, where=misses)  # much faster than enters[misses] = np.inf
    return enters, on_x


def _into_circles(circles: Sequence[Circle], rays: Rays) -> tuple[Numbers, Numbers]:
    """For circles times rays: how far it is, and how squarely it is hit.

    It is the nearer root of |start + t * direction - centre| = radius.
    """
    x_m, y_m, radius_m = np.array([(c.x_m, c.y_m, c.radius_m) for c in circles]).T[:, :, None]
    dx, dy = x_m - rays.x_m, y_m - rays.y_m
    along = dx * rays.cos + dy * rays.sin
    outside = dx * dx + dy * dy - radius_m**2
    root = along * along - outside
    half_chord = np.sqrt(np.maximum(root, 0.0))
    enters = np.where((root >= 0) & (along > 0), along - half_chord, np.inf)
    enters[outside[:, 0] <= 0] = 0.0
    return enters, np.minimum(half_chord / radius_m, 1.0)


def _to_the_walls(room: Box, rays: Rays) -> tuple[Numbers, Numbers]:
    """From inside of a room: to the wall in the east or west, and to that in the north or south."""
    far_x = _spans(rays.x_m, rays.cos, np.array([[room.west_m]]), np.array([[room.east_m]]))[1]
    far_y = _spans(rays.y_m, rays.sin, np.array([[room.south_m]]), np.array([[room.north_m]]))[1]
    return far_x[0], far_y[0]


def _spans(start_m: float, slope: Numbers, low_m: Numbers, high_m: Numbers) -> tuple[Numbers, ...]:
    """From where to where along each ray one coordinate lies between each pair of limits.

    `low_m` and `high_m` are columns; what comes back has a row for each of them.
    """
    flat = np.abs(slope) < PARALLEL
    steep = 1.0 / np.where(flat, 1.0, slope)
    one, two = (low_m - start_m) * steep, (high_m - start_m) * steep
    near, far = np.minimum(one, two), np.maximum(one, two, out=one)
    if flat.any():
        within = (low_m <= start_m) & (start_m <= high_m)
        near[:, flat] = np.where(within, -np.inf, np.inf)
        far[:, flat] = np.where(within, np.inf, -np.inf)
    return near, far
