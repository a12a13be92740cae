"""What is made of the pictures that a ball finder draws on, and which of them are kept."""

from __future__ import annotations

import array
import base64
from typing import Any

import numpy as np
import png
import pytest

from graders.pi_camera.pictures import LARGEST_BYTES, MOST_PICTURES, draw_ring, keep_picture
from roslings.capabilities.camera.pixels import MarkLooker
from roslings.capabilities.camera.record import CameraSeen, PixelsSeen
from roslings.evidence import ExperimentSeen
from roslings_rover.camera import Frame, Light, SyntheticCamera
from roslings_rover.rover import Disc, PinholeCameraModel

BALL = Disc(60.0, 50.0, 15.0, hue=5)
SHOWN = SyntheticCamera(PinholeCameraModel(160, 120), Light(noise=6.0), "bgr8", seed=0).frame(
    [BALL]
)


def message(frame: Frame, **other: Any) -> Any:
    """A sensor_msgs/msg/Image of it."""
    from sensor_msgs.msg import Image

    words = {"width": frame.width, "height": frame.height, "encoding": frame.encoding}
    image = Image(**{**words, "step": frame.step, **other})
    image.data = array.array("B", frame.content)
    return image


def marks(ring: bool, shown: Frame, answer: Frame) -> PixelsSeen:
    """What is said of an answer that has a ring or has none."""
    looker = MarkLooker()
    looker.show(shown, BALL)
    rgb = answer.rgb().copy()
    if ring:
        draw_ring(rgb, BALL.u_px, BALL.v_px, BALL.radius_px + 4)
    content = np.ascontiguousarray(rgb[:, :, ::-1]).tobytes()
    said = Frame(answer.width, answer.height, "bgr8", answer.width * 3, content)
    return PixelsSeen.model_validate(looker.read(message(said))["data"])


def test_a_ring_is_seen_and_so_is_another_picture() -> None:
    """The ring lies around the ball, and all else is as it was shown."""
    with_ring = marks(True, SHOWN, SHOWN)
    assert with_ring.marked is not None and with_ring.marked > 0.05
    assert with_ring.spoiled == 0.0
    assert marks(False, SHOWN, SHOWN).marked == 0.0
    black = Frame(160, 120, "bgr8", 480, bytes(160 * 120 * 3))
    assert marks(True, SHOWN, black).spoiled == pytest.approx(1.0, abs=0.01)


def test_a_kept_picture_is_small_and_whole() -> None:
    """A PNG that any reader opens; no more than a few of them."""
    seen = ExperimentSeen(name="looking", clock="wall")
    noisy = SyntheticCamera(light=Light(noise=20.0)).frame([BALL]).rgb()
    for _ in range(MOST_PICTURES + 2):
        keep_picture(seen, "A ball", "A ball on the floor.", noisy)
    assert len(seen.part(CameraSeen).pictures) == MOST_PICTURES
    content = base64.b64decode(seen.part(CameraSeen).pictures[0].png)
    assert len(content) <= LARGEST_BYTES
    width, height, rows, _ = png.Reader(bytes=content).asRGB8()
    assert (
        (width, height)
        == (seen.part(CameraSeen).pictures[0].width, seen.part(CameraSeen).pictures[0].height)
        == (213, 160)
    )
    pixels = np.array(list(rows), np.uint8).reshape(height, width, 3)
    red, green, _ = pixels[int(BALL.v_px / 3), int(BALL.u_px / 3)]
    assert red > green + 50
