"""Look at a picture that a student hands in; it may be anything."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable, Sequence
from pathlib import Path

import png

from roslings.course import PictureContract
from roslings.evidence import PictureSeen

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
LARGEST_PIXELS = 50_000_000
"""A screen has 8 million. A file of few bytes can claim billions (a decompression bomb)."""

NOT_READABLE = (
    png.Error,
    zlib.error,
    OSError,
    ValueError,
    EOFError,
    struct.error,
    OverflowError,
    MemoryError,
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
    for _ in png.Reader(filename=str(path)).chunks():
        pass  # each part is whole, up to the last one
    reader = png.Reader(filename=str(path))
    reader.preamble()
    if reader.width * reader.height > LARGEST_PIXELS:
        return PictureSeen(path=name, format=None)
    width, height, rows, info = reader.read()
    return PictureSeen(
        path=name, format="PNG", width=width, height=height, colours=_colours(rows, info["planes"])
    )


def _colours(rows: Iterable[Sequence[int]], planes: int) -> int:
    """1 or 2, for two and more: rows are read until the second colour is found."""
    first: list[int] = []
    for row in rows:
        first = first or list(row[:planes])
        if list(row) != first * (len(row) // planes):
            return 2
    return 1
