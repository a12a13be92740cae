"""The camera in a room: walls, boxes and what moves stand in the picture where geometry says."""

from __future__ import annotations

import numpy as np
import pytest

from roslings_rover.camera import Light, SyntheticCamera
from roslings_rover.camera.frame import Pixels
from roslings_rover.camera.room_camera import (
    BOX_RGB,
    MOVING_RGB,
    ROUND_RGB,
    THING_HIGH_M,
    RoomCamera,
    drawn,
)
from roslings_rover.camera.scene import WALL_RGB
from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.pinhole import PinholeCameraModel
from roslings_rover.models.rooms import MovingWorld
from roslings_rover.models.world import Ball, Box, Circle, World
from roslings_rover.rover.rover import Rover

ROOM = Box(-5.0, -5.0, 5.0, 5.0)
EYE = PinholeCameraModel()
QUIET = Light(noise=0.0)
COLOURS = {"box": BOX_RGB, "round": ROUND_RGB, "moving": MOVING_RGB, "wall": WALL_RGB}


def seen(world: World, pose: Pose = Pose()) -> Pixels:  # noqa: B008 - a Pose cannot change
    """The picture from there."""
    return drawn(EYE, world, pose)


def of_colour(picture: Pixels, name: str) -> np.ndarray:
    """Where the picture has this colour, in any light: the one to which its shares are nearest."""
    values = picture.astype(float)
    shares = values / np.maximum(values.sum(axis=2, keepdims=True), 1.0)
    off = {
        each: np.abs(shares - np.array(rgb) / sum(rgb)).sum(axis=2) for each, rgb in COLOURS.items()
    }
    others = np.minimum.reduce([value for each, value in off.items() if each != name])
    found: np.ndarray = (off[name] < others) & (off[name] < 0.02)
    return found


def test_a_box_stands_where_the_pinhole_model_says() -> None:
    """Its edges left and right, its foot on the floor, its top in the air."""
    box = Box(2.08, -0.5, 3.0, 0.5)
    found = of_colour(seen(World(ROOM, (box,))), "box")
    rows, columns = np.nonzero(found[:, :])
    middle_px, far_m = (EYE.width_px - 1) / 2, 2.0
    assert columns.min() == pytest.approx(middle_px - EYE.focal_px * 0.5 / far_m, abs=1.5)
    assert columns.max() == pytest.approx(middle_px + EYE.focal_px * 0.5 / far_m, abs=1.5)
    foot_px = EYE.horizon_px + EYE.focal_px * EYE.height_m / far_m
    top_px = EYE.horizon_px - EYE.focal_px * (THING_HIGH_M - EYE.height_m) / far_m
    assert rows.max() == pytest.approx(foot_px, abs=1.5)
    assert rows.min() == pytest.approx(top_px, abs=1.5)


def test_a_wall_comes_nearer_and_reaches_up() -> None:
    """Its foot goes down as the rover drives towards it; its top is never seen."""
    feet = []
    for x_m in (0.0, 2.0, 4.0):
        picture = seen(World(ROOM), Pose(x_m, 0.0, 0.0))
        rows = np.nonzero(of_colour(picture, "wall")[:, 320])[0]
        assert rows.min() == 0
        feet.append(int(rows.max()))
        depth_m = 5.0 - x_m - EYE.mounted_ahead_m
        assert feet[-1] == pytest.approx(
            EYE.horizon_px + EYE.focal_px * EYE.height_m / depth_m, abs=1.5
        )
    assert feet == sorted(feet) and len(set(feet)) == 3


def test_left_in_the_room_is_left_in_the_picture() -> None:
    """A round thing to the left, one that moves to the right."""
    world = MovingWorld(ROOM, (Circle(2.0, 0.7, 0.2),), moving=(Circle(2.0, -0.7, 0.2),))
    picture = seen(world)
    left = np.nonzero(of_colour(picture, "round"))[1]
    right = np.nonzero(of_colour(picture, "moving"))[1]
    assert left.size > 500 and right.size > 500
    assert left.max() < 320 < right.min()


@pytest.mark.parametrize(("near", "hidden"), [("box", "moving"), ("moving", "box")])
def test_what_is_nearer_hides_what_is_behind_it(near: str, hidden: str) -> None:
    """In each column; nothing of the other one is left."""
    far_m = {near: 1.0, hidden: 2.5}
    x_m = far_m["box"]
    world = MovingWorld(
        ROOM, (Box(x_m, -0.3, x_m + 0.2, 0.3),), moving=(Circle(far_m["moving"], 0.0, 0.29),)
    )
    picture = seen(world)
    assert of_colour(picture, near)[:, 310:330].any()
    assert not of_colour(picture, hidden)[:, 310:330].any()


def test_two_faces_of_a_box_differ() -> None:
    """One sees its corner."""
    picture = seen(World(ROOM, (Box(1.5, -0.2, 2.5, 0.8),)), Pose(0.0, -1.2, 0.6)).astype(int)
    row = picture[int(EYE.horizon_px), of_colour(picture, "box")[int(EYE.horizon_px)]]
    assert np.abs(np.diff(row.sum(axis=1))).max() > 15


def test_no_place_breaks_it() -> None:
    """In a corner, at a box, within a thing, outside of the room."""
    world = MovingWorld(ROOM, (Box(1, -1, 2, 1), Circle(-2, 0, 0.5)), moving=(Circle(0, 3, 0.2),))
    for x_m, y_m in ((5.0, 5.0), (1.0, 0.0), (1.5, 0.0), (-2.0, 0.0), (0.0, 3.0), (9.0, 9.0)):
        for heading in (0.0, 1.0, 3.0):
            assert seen(world, Pose(x_m, y_m, heading)).shape == (480, 640, 3)


def test_a_ball_lies_before_the_wall() -> None:
    """Where the usual camera has it, and the room around it."""
    rover = Rover(World(ROOM, (Box(3.0, -1.0, 3.2, 1.0),), (Ball(2.0, 0.2),)))
    (disc,) = rover.see()
    usual = SyntheticCamera(light=QUIET).look(rover).rgb().astype(int)
    room = RoomCamera(light=QUIET).look(rover).rgb().astype(int)
    at = int(disc.v_px), int(disc.u_px)
    assert (room[at] == usual[at]).all() and room[at][0] > room[at][1] + 50
    assert of_colour(room.astype(np.uint8), "box").any()


def test_the_light_is_that_of_the_camera() -> None:
    """Brightness, noise and encoding, as of the usual one."""
    rover = Rover(World(ROOM))
    dark = RoomCamera(light=Light(brightness=30, noise=0.0)).look(rover).rgb().mean()
    bright = RoomCamera(light=Light(brightness=60, noise=0.0)).look(rover).rgb().mean()
    assert bright > dark + 50
    one, two = (RoomCamera(light=Light(noise=6.0), seed=2).look(rover) for _ in range(2))
    assert one == two
    assert RoomCamera(light=QUIET, encoding="mono8").look(rover).step == 640
