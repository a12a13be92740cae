"""Look at a picture that a student hands in; it may be anything."""

from __future__ import annotations

import time
import zlib
from pathlib import Path

from roslings.course import PictureContract
from roslings.evidence import PictureSeen
from roslings.workspace.errors import PictureTooLarge, PictureTooSlow
from roslings.workspace.png_rows import NotPng, has_one_colour, read_header

BEGINNINGS = {
    b"\x89PNG\r\n\x1a\n": "PNG",
    b"\xff\xd8\xff": "JPEG",
    b"GIF8": "GIF",
    b"BM": "BMP",
    b"RIFF": "WEBP",
    b"II*\x00": "TIFF",
    b"MM\x00*": "TIFF",
}
"""How a file of each format begins; of other formats than PNG no more is told."""

LARGEST_BYTES = 50_000_000
LARGEST_PIXELS = 20_000_000
"""A screen has 8 million. A file of few bytes can claim billions (a decompression bomb)."""
LONGEST_S = 5.0
"""Of a processor."""

NOT_READABLE = (NotPng, zlib.error, OSError)


def look_at(package: Path, contract: PictureContract) -> PictureSeen | None:
    """What the picture of the card is; None where there is no such file in the package.

    `format` is None for a file that is no image, is broken, or is far too large for one. Raises
    PictureTooLarge, PictureTooSlow.
    """
    path = package / contract.path
    if not path.is_file() or not path.resolve().is_relative_to(package.resolve()):
        return None
    seen = PictureSeen(path=contract.path, format=None)
    if path.stat().st_size > LARGEST_BYTES:
        return seen
    try:
        kind = _format(path)
        return _look(path, contract.path) if kind == "PNG" else _named(seen, kind)
    except NOT_READABLE:
        return seen


def _named(seen: PictureSeen, kind: str | None) -> PictureSeen:
    return seen.model_copy(update={"format": kind})


def _format(path: Path) -> str | None:
    with path.open("rb") as file:
        begin = file.read(max(map(len, BEGINNINGS)))
    return next((kind for start, kind in BEGINNINGS.items() if begin.startswith(start)), None)


def _look(path: Path, name: str) -> PictureSeen:
    until_s = time.process_time() + LONGEST_S
    with path.open("rb") as file:
        header = read_header(file)
        if header.width * header.height > LARGEST_PIXELS:
            raise PictureTooLarge(path, header.width, header.height, LARGEST_PIXELS)
        colours = 1
        for is_one in has_one_colour(file, header):
            colours = 1 if is_one else 2
            if time.process_time() > until_s:
                raise PictureTooSlow(path, path.stat().st_size, LONGEST_S)
    return PictureSeen(
        path=name,
        format="PNG",
        width=header.width,
        height=header.height,
        colours=colours,
    )
