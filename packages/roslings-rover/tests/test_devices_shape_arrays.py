"""Rays by arrays: what they say is what the plain rays of `World` say, one by one."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.rooms import room_of
from roslings_rover.models.shape_arrays import (
    Rays,
    box_hits,
    circle_hits,
    distances,
    gaps,
    wall_hits,
)
from roslings_rover.models.world import Ball, Box, Circle, World, default_world
from roslings_rover.rover.made import rover_in
from roslings_rover.rover.quick_scanner import QuickScanner
from roslings_rover.rover.rover import Rover
from roslings_rover.rover.sensors import Scanner

SQUARE = Box(-5.0, -5.0, 5.0, 5.0)
WORLDS = {
    "the course's": default_world(),
    "empty": World(SQUARE),
    "boxes alone": World(SQUARE, (Box(1, -1, 2, 1), Box(-3, 2, -2.9, 4))),
    "round things alone": World(SQUARE, (Circle(2, 0, 0.5),), (Ball(-2, 1),)),
} | {f"room {seed}": room_of(seed).at_first for seed in range(12)}


def poses(world: World) -> list[Pose]:
    """Anywhere, inside of things too; some look exactly along an axis."""
    chance, room = random.Random(4), world.room
    return [
        Pose(
            chance.uniform(room.west_m, room.east_m),
            chance.uniform(room.south_m, room.north_m),
            heading,
        )
        for heading in (0.0, math.pi / 2, math.pi, -math.pi / 2, 0.3, -2.0)
    ]


@pytest.mark.parametrize("name", WORLDS)
def test_the_quick_scanner_reads_what_the_plain_one_reads(name: str) -> None:
    """To a billionth of a metre, with the same noise, and infinite where that is."""
    world = WORLDS[name]
    for pose in poses(world):
        plain = Scanner().read(world, pose, random.Random(7))
        quick = QuickScanner().read(world, pose, random.Random(7))
        assert quick == pytest.approx(plain, abs=1e-9, rel=0)
        assert all(type(each) is float for each in quick)


@pytest.mark.parametrize("place", [(1.0, 0.0), (2.0, 0.5), (0.0, 1.0), (0.0, -1.0), (1.5, 1.0)])
def test_a_ray_along_a_face_is_that_of_the_world(place: tuple[float, float]) -> None:
    """From an edge or a corner of a box, along it and away from it."""
    world = World(SQUARE, (Box(1.0, -1.0, 2.0, 1.0),))
    angles = np.arange(8) * math.pi / 4
    found = distances(world, Rays.towards(*place, angles))
    assert found == pytest.approx([world.distance(*place, float(a)) for a in angles], abs=1e-9)


@pytest.mark.parametrize("name", WORLDS)
def test_gaps_are_those_of_the_world(name: str) -> None:
    """Of all places at once; negative inside."""
    world = WORLDS[name]
    x_m = np.linspace(world.room.west_m, world.room.east_m, 23)[:, None]
    y_m = np.linspace(world.room.south_m, world.room.north_m, 19)[None, :]
    found = gaps(world.shapes, x_m, y_m)
    assert found.shape == (23, 19)
    for (i, j), gap_m in np.ndenumerate(found):
        plain_m = (shape.gap(float(x_m[i, 0]), float(y_m[0, j])) for shape in world.shapes)
        assert gap_m == pytest.approx(min(plain_m, default=math.inf), abs=1e-9)


def test_what_is_hit_squarely_is_told() -> None:
    """A face head-on and one askew, a round thing in its middle and at its rim."""
    ahead, slanted = Rays.towards(0, 0, np.array([0.0])), Rays.towards(0, 0, np.array([0.6]))
    box = [Box(1, -3, 2, 3)]
    assert box_hits(box, ahead).facing[0] == pytest.approx(1.0)
    assert box_hits(box, slanted).facing[0] == pytest.approx(math.cos(0.6))
    assert box_hits(box, ahead).on_x[0] and wall_hits(SQUARE, ahead).on_x[0]
    north = Rays.towards(0, 0, np.array([math.pi / 2]))
    assert not wall_hits(SQUARE, north).on_x[0]
    post = [Circle(2, 0, 1)]
    assert circle_hits(post, ahead).facing[0] == pytest.approx(1.0)
    rim = Rays.towards(0, 0, np.array([math.asin(0.5) - 1e-4]))
    assert circle_hits(post, rim).facing[0] < 0.1
    assert box_hits([], ahead).distance_m[0] == circle_hits([], ahead).distance_m[0] == math.inf


def test_the_bare_rover_scans_as_it_always_did() -> None:
    """In the course's own room, with the same seed: by arrays, and the same."""
    rover, plain = rover_in(None, seed=3), Rover(seed=3)
    assert type(rover) is Rover and isinstance(rover.scanner, QuickScanner)
    assert rover.scan() == pytest.approx(plain.scan(), abs=1e-9, rel=0)
    assert rover.range() == plain.range()
