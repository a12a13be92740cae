"""What is made of the pictures that a node publishes."""

from __future__ import annotations

import array
from typing import Any

import numpy as np
import pytest

from roslings.capabilities.camera.pixels import FilmLooker
from roslings.capabilities.camera.record import PixelsSeen
from roslings_rover.camera import Encoding, Frame, Light, SyntheticCamera
from roslings_rover.rover import Disc, PinholeCameraModel

BALL = Disc(60.0, 50.0, 15.0, hue=5)


def drawn(number: int, encoding: Encoding = "bgr8", idle_bytes: int = 0) -> Frame:
    """A picture with a ball that moves a little."""
    camera = SyntheticCamera(
        PinholeCameraModel(160, 120), Light(noise=6.0), encoding, idle_bytes, seed=number
    )
    return camera.frame([Disc(60.0 + 5 * number, 50.0, 15.0, hue=5)])


FILM = [drawn(number) for number in range(4)]


def message(frame: Frame, **other: Any) -> Any:
    """A sensor_msgs/msg/Image of it."""
    from sensor_msgs.msg import Image

    words = {"width": frame.width, "height": frame.height, "encoding": frame.encoding}
    image = Image(**{**words, "step": frame.step, **other})
    image.data = array.array("B", frame.content)
    return image


def looked(frame: Frame, lighter: float = 0.0, **other: Any) -> PixelsSeen:
    """What the film's looker says of it."""
    looker = FilmLooker(FILM)
    looker.expect_lighter(lighter)
    return PixelsSeen.model_validate(looker.read(message(frame, **other))["data"])


@pytest.mark.parametrize("number", range(4))
def test_each_picture_of_the_film_is_told_from_the_others(number: int) -> None:
    """Exactly; with idle bytes in its rows as well."""
    for idle_bytes in (0, 7):
        seen = looked(drawn(number, idle_bytes=idle_bytes))
        assert (seen.shows, seen.off) == (number, 0.0)
    assert looked(drawn(9)).off > 4  # type: ignore[operator]


def test_red_and_blue_exchanged_is_seen_as_such() -> None:
    """The bytes are right, and the encoding says otherwise."""
    seen = looked(FILM[1], encoding="rgb8")
    assert seen.off is not None and seen.off > 2.5
    assert seen.swapped_off == 0.0


def test_a_wrong_step_alone_does_not_spoil_the_picture() -> None:
    """That is another check's business."""
    assert looked(FILM[2], step=160).off == 0.0


@pytest.mark.parametrize("other", [{"height": 500}, {"encoding": "16UC1"}, {"width": 0}])
def test_bytes_that_are_no_picture(other: dict[str, Any]) -> None:
    """Nothing is made of them, and how many there are is known."""
    seen = looked(FILM[0], **other)
    assert (seen.off, seen.level, seen.bytes) == (None, None, 160 * 120 * 3)


def changed(frame: Frame, levels: int, wrongly: bool) -> Frame:
    """Lighter, cut at 255 or gone round."""
    values = np.frombuffer(frame.content, np.uint8).astype(int) + levels
    right = np.clip(values, 0, 255)
    content = (values % 256 if wrongly else right).astype(np.uint8).tobytes()
    return Frame(frame.width, frame.height, "bgr8", frame.step, content)


def test_a_lighter_picture_is_the_same_picture() -> None:
    """Where it was said before; values that went round are told from those that were cut."""
    right = looked(changed(FILM[3], 79, wrongly=False), lighter=79.05)
    assert (right.shows, right.lighter) == (3, 79.05)
    assert right.off is not None and right.off <= 1
    wrong = looked(changed(FILM[3], 79, wrongly=True), lighter=79.05)
    assert wrong.off is not None and wrong.off > 2.5
    assert wrong.round_off is not None and wrong.round_off <= 1
