"""Messages with a picture, as a browser shows it. Pure: nothing here knows the page or a node.

The encodings are those of sensor_msgs/msg/Image (sensor_msgs/image_encodings.hpp).
"""

from __future__ import annotations

import base64
import struct
import zlib
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ros2_on_pip.problem import CommandProblem

MOST_PIXELS = 4_096 * 4_096
PNG, JPEG = b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff"
QUICK = 1
"""Of zlib: a picture is shown once, so time counts more than its size."""


class UnshowableImage(CommandProblem):
    """The message is no picture that can be shown."""

    def __init__(self, why: str) -> None:
        super().__init__(
            f"This picture cannot be shown: {why}. Look at the node that publishes it."
        )


@dataclass(frozen=True)
class Encoding:
    """How a pixel lies in the bytes."""

    kind: str
    """Of one value, for numpy: `u1`, `u2`, `f4`."""
    channels: int
    order: tuple[int, ...]
    """Which of them are red, green and blue; one for a picture in grey."""


ENCODINGS = {
    "mono8": Encoding("u1", 1, (0,)),
    "8UC1": Encoding("u1", 1, (0,)),
    "rgb8": Encoding("u1", 3, (0, 1, 2)),
    "bgr8": Encoding("u1", 3, (2, 1, 0)),
    "8UC3": Encoding("u1", 3, (2, 1, 0)),
    "rgba8": Encoding("u1", 4, (0, 1, 2)),
    "bgra8": Encoding("u1", 4, (2, 1, 0)),
    "mono16": Encoding("u2", 1, (0,)),
    "16UC1": Encoding("u2", 1, (0,)),
    "32FC1": Encoding("f4", 1, (0,)),
}


@dataclass(frozen=True)
class ShownImage:
    """What the page shows."""

    address: str
    """`data:image/...`"""
    words: str
    """Its size and its encoding."""
    brightness: float | None = None
    """The mean of all values, 0 to 255; None where it is not known."""


def picture_of(message: Any) -> ShownImage:
    """Of a sensor_msgs/msg/Image or CompressedImage. Raises UnshowableImage."""
    return _raw(message) if hasattr(message, "encoding") else _compressed(message)


def _raw(message: Any) -> ShownImage:
    encoding = ENCODINGS.get(message.encoding)
    if encoding is None:
        there = ", ".join(ENCODINGS)
        raise UnshowableImage(f"its encoding is '{message.encoding}', and known are {there}")
    values = _values(message, encoding)
    shown = values if encoding.kind == "u1" else _as_bytes(values)
    words = f"{message.width} x {message.height}, {message.encoding}"
    mean = float(shown.mean())
    return ShownImage(_address("png", png(shown)), words, mean)


def _values(message: Any, encoding: Encoding) -> NDArray[Any]:
    """height x width, or height x width x 3 (red, green, blue)."""
    wide, high, step = message.width, message.height, message.step
    if not 0 < wide * high <= MOST_PIXELS:
        raise UnshowableImage(f"it is {wide} x {high} pixels")
    kind = np.dtype(encoding.kind).newbyteorder(">" if message.is_bigendian else "<")
    row_b = wide * encoding.channels * kind.itemsize
    if step < row_b:
        raise UnshowableImage(f"its step is {step}, and a row has {row_b} bytes")
    if len(message.data) != step * high:
        raise UnshowableImage(
            f"it has {len(message.data)} bytes, and step {step} x height {high} is {step * high}"
        )
    rows = np.frombuffer(bytes(message.data), np.uint8).reshape(high, step)[:, :row_b]
    shape = (high, wide, encoding.channels)
    values: NDArray[Any] = np.ascontiguousarray(rows).view(kind).reshape(shape)
    return values[:, :, 0] if len(encoding.order) == 1 else values[:, :, list(encoding.order)]


def _as_bytes(values: NDArray[Any]) -> NDArray[np.uint8]:
    """The least finite value is black, the most is white; what is not finite is black."""
    numbers = values.astype(np.float64)
    finite = np.isfinite(numbers)
    if not finite.any():
        return np.zeros(numbers.shape, np.uint8)
    known = numbers[finite]
    least, most = float(np.min(known)), float(np.max(known))
    scaled = np.where(finite, (numbers - least) / max(most - least, 1e-12) * 255, 0)
    return scaled.astype(np.uint8)


def _compressed(message: Any) -> ShownImage:
    content = bytes(message.data)
    for kind, magic in (("png", PNG), ("jpeg", JPEG)):
        if content.startswith(magic):
            return ShownImage(_address(kind, content), f"{message.format}, {len(content)} bytes")
    raise UnshowableImage(f"its format is '{message.format}', and its bytes are no PNG and no JPEG")


def _address(kind: str, content: bytes) -> str:
    return f"data:image/{kind};base64,{base64.b64encode(content).decode()}"


def png(pixels: NDArray[np.uint8]) -> bytes:
    """height x width (grey) or height x width x 3 as a PNG file (W3C, PNG 3rd edition)."""
    high, wide = pixels.shape[:2]
    colour = 2 if pixels.ndim == 3 else 0
    rows = np.ascontiguousarray(pixels).reshape(high, -1)
    unfiltered = np.concatenate([np.zeros((high, 1), np.uint8), rows], axis=1).tobytes()
    head = struct.pack(">IIBBBBB", wide, high, 8, colour, 0, 0, 0)
    chunks = ((b"IHDR", head), (b"IDAT", zlib.compress(unfiltered, QUICK)), (b"IEND", b""))
    return PNG + b"".join(_chunk(name, content) for name, content in chunks)


def _chunk(name: bytes, content: bytes) -> bytes:
    check = zlib.crc32(name + content)
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", check)
