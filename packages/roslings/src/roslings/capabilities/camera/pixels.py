"""Reads Image messages when they come: their fields, and which known picture they show."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from roslings.capabilities.camera.record import PixelsSeen
from roslings_rover.camera import CHANNELS, ENCODINGS, Frame, NotAnImage
from roslings_rover.rover import Disc

IMAGE = "sensor_msgs/msg/Image"
EVERY = 8
"""Of each picture, every eighth row and column is compared: a hundred times quicker."""

DRAWN_LEVELS = 40
FAR_LEVELS = 2.0
MARGIN_PX = 12.0
AROUND = 1.8
"""A ring around a ball is looked for up to so many of its radii from its centre."""

Pixels = npt.NDArray[np.uint8]
Thumb = npt.NDArray[np.int16]


def pixels_of(message: Any) -> Pixels | None:
    """Rows, columns, red green blue; None where the bytes cannot be read.

    Where only `step` does not fit the bytes, they are read as if it did: that is another fault.
    """
    if message.encoding not in ENCODINGS or not message.width or not message.height:
        return None
    row = message.width * CHANNELS[message.encoding]
    content = bytes(message.data)
    step = message.step if len(content) == message.step * message.height else row
    try:
        return Frame(message.width, message.height, message.encoding, step, content).rgb()
    except NotAnImage:
        return None


def fields_of(message: Any, pixels: PixelsSeen) -> dict[str, Any]:
    """The plain values of an Image, with what was seen in the place of its bytes."""
    stamp = message.header.stamp
    return {
        "header": {
            "stamp": {"sec": stamp.sec, "nanosec": stamp.nanosec},
            "frame_id": message.header.frame_id,
        },
        "height": message.height,
        "width": message.width,
        "encoding": message.encoding,
        "is_bigendian": message.is_bigendian,
        "step": message.step,
        "data": pixels.model_dump(),
    }


class FilmLooker:
    """Knows the pictures of a film, and tells which one a message shows."""

    def __init__(self, film: Sequence[Frame]) -> None:
        self._thumbs = np.stack([_thumb(frame.rgb()) for frame in film])
        self._lit = {0.0: self._thumbs}

    def expect_lighter(self, levels: float) -> None:
        """From now on, a picture may be lighter than in the film by so many levels, cut at 255."""
        lit = np.clip(np.rint(self._thumbs + levels), 0, 255)
        self._lit = {**self._lit, levels: lit.astype(np.int16)}

    def read(self, message: Any) -> dict[str, Any]:
        """What is kept of a message."""
        rgb, size = pixels_of(message), len(message.data)
        if rgb is None:
            return fields_of(message, PixelsSeen(bytes=size))
        thumb = _thumb(rgb)
        seen = PixelsSeen(bytes=size, level=float(thumb.mean()))
        if thumb.shape == self._thumbs.shape[1:]:
            self._compare(thumb, seen)
        return fields_of(message, seen)

    def _compare(self, thumb: Thumb, seen: PixelsSeen) -> None:
        for lighter, film in self._lit.items():
            offs = np.abs(film - thumb).mean(axis=(1, 2, 3))
            best = int(np.argmin(offs))
            if seen.off is None or offs[best] < seen.off:
                seen.shows, seen.off, seen.lighter = best, float(offs[best]), lighter
        swapped = np.abs(self._lit[seen.lighter] - thumb[:, :, ::-1]).mean(axis=(1, 2, 3))
        seen.swapped_off = float(np.min(swapped))
        if seen.off is not None and seen.off > FAR_LEVELS:
            seen.round_off = min(map(float, self._beyond(thumb)))

    def _beyond(self, thumb: Thumb) -> Iterator[np.floating[Any]]:
        """How far it is from films whose values were not cut at 0 and 255."""
        for levels in self._lit:
            lit = np.rint(self._thumbs + levels).astype(np.int16)
            for wrong in (lit % 256, np.minimum(np.abs(lit), 255)):
                yield np.min(np.abs(wrong - thumb).mean(axis=(1, 2, 3)))


def _thumb(rgb: Pixels) -> Thumb:
    return rgb[::EVERY, ::EVERY].astype(np.int16)


class MarkLooker:
    """Compares a message with the one picture that was shown, and tells what was drawn on it."""

    def __init__(self) -> None:
        self.latest: Pixels | None = None
        self._shown: Pixels | None = None
        self._disc: Disc | None = None

    def show(self, frame: Frame, disc: Disc | None) -> None:
        """The picture that is shown now, and the ball in it."""
        self._shown, self._disc, self.latest = frame.rgb(), disc, None

    def read(self, message: Any) -> dict[str, Any]:
        """What is kept of a message."""
        rgb = pixels_of(message)
        seen = PixelsSeen(bytes=len(message.data))
        if rgb is not None:
            seen.level = float(rgb.mean())
            self.latest = rgb
        if rgb is not None and self._shown is not None and rgb.shape == self._shown.shape:
            self._compare(rgb, self._shown, seen)
        return fields_of(message, seen)

    def _compare(self, rgb: Pixels, shown: Pixels, seen: PixelsSeen) -> None:
        drawn = (np.abs(rgb.astype(np.int16) - shown) > DRAWN_LEVELS).any(axis=2)
        swapped = (np.abs(rgb[:, :, ::-1].astype(np.int16) - shown) > DRAWN_LEVELS).any(axis=2)
        near = self._near(drawn.shape)
        seen.spoiled = float(drawn[~near].mean())
        seen.swapped_off = float(swapped[~near].mean())
        seen.marked = float(drawn[near].mean()) if near.any() else 0.0
        seen.swapped_marked = float(swapped[near].mean()) if near.any() else 0.0

    def _near(self, shape: tuple[int, ...]) -> npt.NDArray[np.bool_]:
        if self._disc is None:
            return np.zeros(shape, np.bool_)
        rows, columns = np.ogrid[: shape[0], : shape[1]]
        away = np.hypot(columns - self._disc.u_px, rows - self._disc.v_px)
        near: npt.NDArray[np.bool_] = away < AROUND * self._disc.radius_px + MARGIN_PX
        return near
