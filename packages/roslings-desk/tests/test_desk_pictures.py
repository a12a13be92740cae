"""Pictures of all encodings, good and bad, as a browser shows them."""

from __future__ import annotations

import base64
import io
import struct
from importlib import import_module
from typing import Any

import pytest
from PIL import Image as Decoded

from roslings_desk.pictures import UnshowableImage, picture_of
from skips import skip_without

skip_without("module rclpy")
messages = import_module("sensor_msgs.msg")


def image(encoding: str, data: bytes, wide: int = 2, high: int = 1, **more: Any) -> Any:
    """A message; its step is right where nothing else is said."""
    more.setdefault("step", len(data) // max(high, 1))
    return messages.Image(encoding=encoding, data=data, width=wide, height=high, **more)


def pixels(message: Any) -> list[Any]:
    """What somebody else's reader of PNG finds in it."""
    content = base64.b64decode(picture_of(message).address.partition(",")[2])
    picture = Decoded.open(io.BytesIO(content))
    places = [(x, y) for y in range(picture.height) for x in range(picture.width)]
    return [picture.getpixel(place) for place in places]


@pytest.mark.parametrize(
    ("encoding", "data", "found"),
    [
        ("mono8", b"\x00\xff", [0, 255]),
        ("rgb8", b"\x01\x02\x03\x04\x05\x06", [(1, 2, 3), (4, 5, 6)]),
        ("bgr8", b"\x01\x02\x03\x04\x05\x06", [(3, 2, 1), (6, 5, 4)]),
        ("rgba8", b"\x01\x02\x03\x09\x04\x05\x06\x09", [(1, 2, 3), (4, 5, 6)]),
        ("bgra8", b"\x01\x02\x03\x09\x04\x05\x06\x09", [(3, 2, 1), (6, 5, 4)]),
        ("mono16", struct.pack("<HH", 100, 1_100), [0, 255]),
        ("32FC1", struct.pack("<ff", 0.5, 2.0), [0, 255]),
        ("32FC1", struct.pack("<ff", float("nan"), float("inf")), [0, 0]),
    ],
)
def test_each_encoding_has_its_colours(encoding: str, data: bytes, found: list[Any]) -> None:
    """Depth from the nearest to the farthest; what is not finite is black."""
    assert pixels(image(encoding, data)) == found


def test_rows_may_be_longer_than_their_pixels() -> None:
    """The step says where the next one begins."""
    padded = image("mono8", b"\x01\x02..\x03\x04..", high=2, step=4)
    assert pixels(padded) == [1, 2, 3, 4]


def test_the_order_of_bytes_is_the_messages_own() -> None:
    """A big-endian picture of depth."""
    assert pixels(image("16UC1", struct.pack(">HH", 256, 1), is_bigendian=1)) == [255, 0]


def test_its_brightness_is_the_mean() -> None:
    """Of all values."""
    assert picture_of(image("mono8", b"\x32\x34")).brightness == 51


@pytest.mark.parametrize(
    ("message", "said"),
    [
        (lambda: image("mono8", b"ab", step=1), "its step is 1, and a row has 2 bytes"),
        (lambda: image("rgb8", b"abcdef", step=3), "its step is 3, and a row has 6 bytes"),
        (lambda: image("mono8", b"abc", step=2), "it has 3 bytes, and step 2 x height 1 is 2"),
        (lambda: image("mono8", b"", wide=0, high=0, step=0), "it is 0 x 0 pixels"),
        (lambda: image("mono8", b"ab", wide=2**31, step=2**31), "pixels"),
        (lambda: image("yuv422", b"abcd"), "its encoding is 'yuv422'"),
        (lambda: messages.CompressedImage(format="jpeg", data=b"<html>"), "no PNG and no JPEG"),
        (lambda: messages.CompressedImage(), "no PNG and no JPEG"),
    ],
)
def test_a_wrong_picture_is_told(message: Any, said: str) -> None:
    """With the numbers that do not fit."""
    with pytest.raises(UnshowableImage, match=said):
        picture_of(message())


def test_a_compressed_picture_is_passed_on_as_it_is() -> None:
    """By its first bytes, whatever its format says."""
    made = io.BytesIO()
    Decoded.new("RGB", (3, 2), (1, 2, 3)).save(made, "JPEG")
    found = picture_of(messages.CompressedImage(format="png", data=made.getvalue()))
    assert found.address.startswith("data:image/jpeg;base64,")
    assert base64.b64decode(found.address.partition(",")[2]) == made.getvalue()
