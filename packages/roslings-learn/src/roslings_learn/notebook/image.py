"""A sensor_msgs/Image below a cell."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Any

from roslings_learn.notebook.errors import NotebookTrouble
from roslings_learn.notebook.picture import NotebookPicture, show

CHANNELS = {"rgb8": "RGB", "bgr8": "BGR", "rgba8": "RGBA", "bgra8": "BGRA", "mono8": "L"}
"""Encoding to the order of its bytes."""

SHOWN_PX = 480
"""A smaller picture is shown larger, pixel by pixel."""


class BadImage(NotebookTrouble):
    """The message does not hold the picture that it promises."""


def show_image(image: Any) -> None:
    """Show a sensor_msgs/Image. Raises BadImage."""
    show(image_picture(image))


def image_picture(image: Any) -> NotebookPicture:
    """The picture that `show_image` shows. Raises BadImage."""
    _check(image)
    order = CHANNELS[image.encoding]
    middle = _pixel(image, image.height // 2, image.width // 2, order)
    alt = (
        f"A camera picture, {image.width} by {image.height} pixels, encoding {image.encoding}."
        f" The pixel in the middle has the colour {middle}."
    )
    width = max(image.width, SHOWN_PX)
    return NotebookPicture(
        _png(image, order), "image/png", alt, width, pixelated=image.width < width
    )


def _check(image: Any) -> None:
    if not hasattr(image, "encoding"):
        raise BadImage(f"{type(image).__name__} is no picture. Give one sensor_msgs/msg/Image.")
    if image.encoding not in CHANNELS:
        known = ", ".join(CHANNELS)
        raise BadImage(f"The encoding is {image.encoding!r}. show_image knows: {known}.")
    row, wanted = image.width * len(CHANNELS[image.encoding]), image.height * image.step
    if not image.width or not image.height or image.step < row or len(image.data) < wanted:
        raise BadImage(
            f"The sizes do not fit: {image.width} x {image.height} pixels in {image.encoding}"
            f" need step {row} and {row * image.height} bytes of data."
            f" There are step {image.step} and {len(image.data)} bytes."
        )


def _pixel(image: Any, row: int, column: int, order: str) -> str:
    at = row * image.step + column * len(order)
    values = dict(zip(order, bytes(image.data[at : at + len(order)]), strict=True))
    return ", ".join(f"{name} {values[name]}" for name in sorted(order, key="RGBAL".index))


def _png(image: Any, order: str) -> bytes:
    import png

    file = io.BytesIO()
    writer = png.Writer(
        image.width, image.height, greyscale=order == "L", alpha="A" in order, bitdepth=8
    )
    writer.write(file, _rows(image, order))
    return file.getvalue()


def _rows(image: Any, order: str) -> Iterator[bytearray]:
    """The rows with red first; what fills up a row is left out."""
    size, content = len(order), bytes(image.data)
    for top in range(0, image.height * image.step, image.step):
        row = bytearray(content[top : top + image.width * size])
        if order.startswith("BGR"):
            row[0::size], row[2::size] = row[2::size], row[0::size]
        yield row
