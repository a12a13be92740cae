"""Prints figures of the lab with the camera; asserts nothing.

    .venv/bin/python tests/bench/camera.py [PICTURES]

PICTURES is how many are taken for each figure (300 without it). With the group `vision`
installed (`./roslings check pi-camera --solution` does that).
"""

from __future__ import annotations

import array
import sys
import time
from collections.abc import Callable
from typing import Any

import cv2
import numpy as np

from roslings.capabilities.camera.pixels import FilmLooker, MarkLooker
from roslings.course import lab
from roslings_rover.camera import Light, SyntheticCamera
from roslings_rover.rover import Disc

sys.path.insert(0, str(lab("pi-camera").solution))
from pi_camera.ball_finder import find_ball, picture_of  # type: ignore[import-not-found]

BALL = Disc(300.0, 200.0, 50.0, hue=5)
HZ = 15.0


def report(name: str, work: Callable[[], object], count: int) -> None:
    """Time of the processor for each picture, and what that is at the card's rate."""
    began_s = time.process_time()
    for _ in range(count):
        work()
    each_s = (time.process_time() - began_s) / count
    print(f"{name:46} {each_s * 1000:7.2f} ms, {each_s * HZ:6.1%} of a core at {HZ:g} Hz")


def main(count: int) -> None:
    """All figures."""
    from rclpy.serialization import deserialize_message, serialize_message
    from sensor_msgs.msg import Image

    camera = SyntheticCamera(light=Light(noise=6.0), encoding="bgr8")
    film = [camera.frame([BALL]) for _ in range(16)]
    picture = np.ascontiguousarray(film[0].pixels())
    image: Any = Image(width=640, height=480, step=1920, encoding="bgr8")

    def put(content: object) -> None:
        image.data = content

    print("One picture of 640 x 480 in bgr8:")
    report("drawn by the synthetic camera", lambda: camera.frame([BALL]), count)
    report(
        "data = array('B', tobytes())  (2 copies)",
        lambda: put(array.array("B", picture.tobytes())),
        count,
    )
    report("data = tobytes()", lambda: put(picture.tobytes()), count)
    report("data = flatten().tolist()", lambda: put(picture.flatten().tolist()), count // 10)
    raw = serialize_message(image)
    report("published (made into bytes)", lambda: serialize_message(image), count)
    report("received (made of bytes)", lambda: deserialize_message(raw, Image), count)
    report("read by numpy, and copied once", lambda: picture_of(image), count)
    report("made lighter (cv2.add)", lambda: cv2.add(picture, (77, 77, 77, 0)), count)
    report("searched for the ball", lambda: find_ball(picture, 5), count)
    known, marks = FilmLooker(film), MarkLooker()
    marks.show(film[0], BALL)
    report("grader: which picture of the film is it", lambda: known.read(image), count)
    report("grader: what was drawn on it", lambda: marks.read(image), count)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 300)
