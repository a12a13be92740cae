"""One picture as a ROS Image message holds it: bytes, and the header that tells how to read them.

The encodings are those of sensor_msgs/image_encodings.hpp; the shades of grey are ITU-R BT.601's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

Encoding = Literal["rgb8", "bgr8", "mono8"]
ENCODINGS: tuple[Encoding, ...] = ("rgb8", "bgr8", "mono8")
CHANNELS: dict[Encoding, int] = {"rgb8": 3, "bgr8": 3, "mono8": 1}
GREY_OF_RGB = (77, 150, 29)
"""0.299, 0.587 and 0.114 of 256."""

Pixels = npt.NDArray[np.uint8]


class NotAnImage(ValueError):
    """The bytes and what the header says of them do not fit."""


@dataclass(frozen=True)
class Frame:
    """A picture, row by row from above; each row is `step` bytes long, of which some may be idle.

    Raises NotAnImage where there are fewer bytes than the header says.
    """

    width: int
    height: int
    encoding: Encoding
    step: int
    content: bytes

    def __post_init__(self) -> None:
        needed = self.width * CHANNELS[self.encoding]
        if self.step < needed:
            raise NotAnImage(f"a row of {self.step} bytes is too short: it needs {needed}")
        if len(self.content) < self.step * self.height:
            said = f"{self.step} bytes a row and {self.height} rows"
            raise NotAnImage(f"{len(self.content)} bytes are too few for {said}")

    def pixels(self) -> Pixels:
        """The picture without idle bytes, in its own encoding: rows, columns, and 1 or 3 values."""
        channels = CHANNELS[self.encoding]
        rows: Any = np.frombuffer(self.content, np.uint8, self.step * self.height)
        used = rows.reshape(self.height, self.step)[:, : self.width * channels]
        return np.ascontiguousarray(used).reshape(self.height, self.width, channels)

    def rgb(self) -> Pixels:
        """The picture as red, green and blue, whatever its encoding."""
        pixels = self.pixels()
        if self.encoding == "mono8":
            return np.repeat(pixels, 3, axis=2)
        return pixels if self.encoding == "rgb8" else pixels[:, :, ::-1]


def frame_of(rgb: Pixels, encoding: Encoding = "rgb8", idle_bytes: int = 0) -> Frame:
    """A picture of rows, columns and (red, green, blue) in an encoding; each row ends in so many
    bytes that mean nothing."""
    height, width, _ = rgb.shape
    flat = _encoded(rgb, encoding).reshape(height, -1)
    if idle_bytes:
        flat = np.pad(flat, ((0, 0), (0, idle_bytes)), constant_values=0xA5)
    return Frame(width, height, encoding, flat.shape[1], np.ascontiguousarray(flat).tobytes())


def _encoded(rgb: Pixels, encoding: Encoding) -> Pixels:
    if encoding == "mono8":
        red, green, blue = (rgb[:, :, i].astype(np.uint16) * GREY_OF_RGB[i] for i in range(3))
        return ((red + green + blue) >> 8).astype(np.uint8)
    return rgb if encoding == "rgb8" else rgb[:, :, ::-1]
