"""Look at a picture that a student hands in; it may be anything."""

from __future__ import annotations

import struct
from pathlib import Path

from PIL import Image

from roslings.course import PictureContract
from roslings.evidence import PictureSeen

FORMATS = ("PNG", "JPEG", "GIF", "BMP", "WEBP", "TIFF", "PPM")
LARGEST_BYTES = 50_000_000
LARGEST_PIXELS = 50_000_000
"""A screen has 8 million. A file of few bytes can claim billions (a decompression bomb)."""
MOST_COLOURS = 256
NOT_READABLE = (
    OSError,
    SyntaxError,  # what Pillow raises for a broken PNG
    ValueError,
    EOFError,
    struct.error,
    OverflowError,
    MemoryError,
    Image.DecompressionBombError,
)


def look_at(package: Path, contract: PictureContract) -> PictureSeen | None:
    """What the picture of the card is; None where there is no such file in the package.

    `format` is None for a file that is no image, is broken, or is far too large for one.
    """
    path = package / contract.path
    if not path.is_file() or not path.resolve().is_relative_to(package.resolve()):
        return None
    seen = PictureSeen(path=contract.path, format=None)
    if path.stat().st_size > LARGEST_BYTES:
        return seen
    try:
        return _look(path, contract.path)
    except NOT_READABLE:
        return seen


def _look(path: Path, name: str) -> PictureSeen:
    with Image.open(path, formats=FORMATS) as image:
        width, height = image.size
        if width * height > LARGEST_PIXELS:
            return PictureSeen(path=name, format=None)
        return PictureSeen(
            path=name, format=image.format, width=width, height=height, colours=_colours(image)
        )


def _colours(image: Image.Image) -> int:
    """Different colours, counted up to MOST_COLOURS."""
    found = image.convert("RGBA").getcolors(MOST_COLOURS)
    return MOST_COLOURS if found is None else len(found)
