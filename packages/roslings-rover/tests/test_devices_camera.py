"""The synthetic camera: what it shows, in which bytes, under which light."""

from __future__ import annotations

import numpy as np
import pytest

from roslings_rover.camera import ENCODINGS, Encoding, Frame, Light, NotAnImage, SyntheticCamera
from roslings_rover.camera.frame import Pixels, frame_of
from roslings_rover.rover import Ball, Box, Disc, PinholeCameraModel, Rover, World

QUIET = Light(noise=0.0)
RED = Disc(u_px=200.0, v_px=300.0, radius_px=40.0, hue=0)


def centre_of_red(rgb: Pixels) -> tuple[float, float, int]:
    """Column, row and number of the pixels that are clearly red."""
    red, green, blue = (rgb[:, :, i].astype(int) for i in range(3))
    rows, columns = np.nonzero((red > green + 40) & (red > blue + 40))
    return float(columns.mean()), float(rows.mean()), rows.size


@pytest.mark.parametrize("encoding", ["rgb8", "bgr8"])
@pytest.mark.parametrize("idle_bytes", [0, 7])
def test_a_ball_is_where_it_was_put(encoding: Encoding, idle_bytes: int) -> None:
    """In every encoding with colour, and with rows of any length; its size is that of a disc."""
    camera = SyntheticCamera(light=QUIET, encoding=encoding, idle_bytes=idle_bytes)
    frame = camera.frame([RED])
    assert frame.step == 640 * 3 + idle_bytes
    assert len(frame.content) == frame.step * 480
    column, row, size = centre_of_red(frame.rgb())
    assert (column, row) == (pytest.approx(200.0, abs=0.5), pytest.approx(300.0, abs=0.5))
    assert size == pytest.approx(np.pi * 40**2, rel=0.03)


def test_grey_is_what_the_eye_weighs() -> None:
    """One byte a pixel; red, green and blue count 30, 59 and 11 per cent."""
    rgb = np.array([[[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]]], np.uint8)
    frame = frame_of(rgb, "mono8")
    assert frame.step == 4
    assert list(frame.content) == [76, 149, 28, 255]


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("size", [(1, 1), (7, 5), (33, 17), (641, 479)])
def test_odd_sizes_come_back_whole(encoding: Encoding, size: tuple[int, int]) -> None:
    """With idle bytes that no even number divides."""
    camera = SyntheticCamera(PinholeCameraModel(*size), encoding=encoding, idle_bytes=3)
    frame = camera.frame([RED])
    assert (frame.width, frame.height) == size
    assert frame.rgb().shape == (size[1], size[0], 3)


def test_a_camera_sees_what_the_rover_sees() -> None:
    """The ball of the course's room, where the pinhole model says."""
    rover = Rover()
    (disc,) = rover.see()
    column, row, _ = centre_of_red(SyntheticCamera(light=QUIET).look(rover).rgb())
    assert (column, row) == (pytest.approx(disc.u_px, abs=1), pytest.approx(disc.v_px, abs=1))


def test_the_nearer_ball_hides_the_farther_one() -> None:
    """Drawn last."""
    room = Box(-9, -9, 9, 9)
    near, far = Ball(1.0, 0.0, hue=60), Ball(2.0, 0.0, hue=0)
    for balls in ((near, far), (far, near)):
        rover = Rover(World(room, balls=balls))
        frame = SyntheticCamera(light=QUIET).look(rover)
        disc = rover.see()[-1]
        red, green, _ = frame.rgb()[int(disc.v_px), int(disc.u_px)]
        assert green > red + 50


def test_brightness_from_51_to_81_lifts_the_picture() -> None:
    """By 2.55 levels a point; at the top it stops."""
    camera = SyntheticCamera(light=Light(brightness=51, noise=0.0))
    before = camera.frame([]).rgb().mean()
    camera.light = Light(brightness=81, noise=0.0)
    after = camera.frame([]).rgb().mean()
    assert after - before == pytest.approx(30 * 2.55, abs=6)
    camera.light = Light(brightness=100, noise=0.0)
    assert camera.frame([]).rgb().max() == 255


def test_the_hue_of_the_balls_can_be_set() -> None:
    """From red to green."""
    camera = SyntheticCamera(light=Light(ball_hue=60, noise=0.0))
    red, green, blue = camera.frame([RED]).rgb()[300, 200]
    assert green > red + 50 and green > blue + 50


def test_noise_is_as_strong_as_asked_and_repeats_with_its_seed() -> None:
    """Each frame has its own."""
    quiet = SyntheticCamera(light=QUIET).frame([]).rgb().astype(int)
    one, two = (SyntheticCamera(light=Light(noise=8.0), seed=4) for _ in range(2))
    first, second = one.frame([]), one.frame([])
    assert two.frame([]) == first
    assert second != first
    assert (first.rgb() - quiet).std() == pytest.approx(8.0, rel=0.05)
    assert abs((first.rgb() - quiet).mean()) < 0.1


@pytest.mark.parametrize(
    "wrong", [{"brightness": 101}, {"brightness": -1}, {"ball_hue": 180}, {"noise": -1.0}]
)
def test_a_light_that_no_camera_has_is_refused(wrong: dict[str, int]) -> None:
    """With its limits."""
    with pytest.raises(ValueError, match="is 0"):
        Light(**wrong)


@pytest.mark.parametrize(("step", "content"), [(2, b"x" * 100), (6, b"x" * 11)])
def test_bytes_that_do_not_fit_their_header_are_refused(step: int, content: bytes) -> None:
    """A row that is too short, and a picture that ends too early."""
    with pytest.raises(NotAnImage, match="bytes"):
        Frame(2, 2, "rgb8", step, content)
