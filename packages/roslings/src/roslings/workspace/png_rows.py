"""Tell a PNG of one colour from all others, row by row: in little memory, and in linear time.

PNG (Portable Network Graphics) Specification, W3C: chunks (5), filters (9), Adam7 (8). No row is
unfiltered: of a picture of one colour it is known what each filter makes of each row.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import IO

SIGNATURE = b"\x89PNG\r\n\x1a\n"
PIECE_BYTES = 64 * 1024
PLANES = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}
"""Colour type to numbers a pixel."""
DEPTHS = {0: (1, 2, 4, 8, 16), 2: (8, 16), 3: (1, 2, 4, 8), 4: (8, 16), 6: (8, 16)}
PALETTE = 3
ADAM7 = (
    (0, 0, 8, 8),
    (4, 0, 8, 8),
    (0, 4, 4, 8),
    (2, 0, 4, 4),
    (0, 2, 2, 4),
    (1, 0, 2, 2),
    (0, 1, 1, 2),
)
"""First column and row of each pass, and the steps from there."""
NONE, SUB, UP, AVERAGE, PAETH = range(5)


class NotPng(ValueError):
    """The bytes are no PNG, or not all of one."""


@dataclass(frozen=True)
class Header:
    """What stands at the beginning."""

    width: int
    height: int
    depth: int
    colour_type: int
    is_interlaced: bool

    @property
    def pixel_bits(self) -> int:
        """Of one pixel, all its numbers together."""
        return PLANES[self.colour_type] * self.depth

    def passes(self) -> Iterator[tuple[int, int]]:
        """Columns and rows of each pass that has any; one pass where it is not interlaced."""
        steps = ADAM7 if self.is_interlaced else ((0, 0, 1, 1),)
        for column, row, across, down in steps:
            size = -(-(self.width - column) // across), -(-(self.height - row) // down)
            if min(size) > 0:
                yield size


def read_header(file: IO[bytes]) -> Header:
    """The first chunk. Raises NotPng."""
    if file.read(len(SIGNATURE)) != SIGNATURE or file.read(8) != b"\x00\x00\x00\x0dIHDR":
        raise NotPng("it does not begin as one")
    content = file.read(17)
    if len(content) < 17 or zlib.crc32(b"IHDR" + content[:13]) != _number(content[13:]):
        raise NotPng("the header is broken")
    width, height, depth, colour, packed, filtered, interlaced = struct.unpack(
        ">IIBBBBB", content[:13]
    )
    if depth not in DEPTHS.get(colour, ()) or packed or filtered or interlaced > 1:
        raise NotPng("the header says what no header says")
    if not width or not height:
        raise NotPng("it has no pixels")
    return Header(width, height, depth, colour, bool(interlaced))


def has_one_colour(file: IO[bytes], header: Header) -> Iterator[bool]:
    """Row by row, whether all so far are of one colour; the file stands behind its header.

    After the first False, only what is left of the file is looked at: whether it is whole. Raises
    NotPng, zlib.error.
    """
    pieces = _image(file, header)
    colour = OneColourRows(header)
    for row in _rows(_inflated(pieces), header):
        is_one = colour.takes(*row)
        yield is_one
        if not is_one:
            break
    for _ in pieces:
        pass


def _image(file: IO[bytes], header: Header) -> Iterator[bytes]:
    """What is packed in the chunks IDAT; each chunk is whole, up to the last one."""
    has_palette = header.colour_type != PALETTE
    while True:
        head = file.read(8)
        length, kind = _number(head[:4]), head[4:]
        is_image = kind == b"IDAT"
        if is_image and not has_palette:
            raise NotPng("the palette is missing")
        for piece in _whole(file, length, kind):
            if is_image:
                yield piece
        has_palette = has_palette or kind == b"PLTE"
        if kind == b"IEND":
            return


def _whole(file: IO[bytes], length: int, kind: bytes) -> Iterator[bytes]:
    check = zlib.crc32(kind)
    while length:
        piece = file.read(min(length, PIECE_BYTES))
        if not piece:
            raise NotPng("it ends too early")
        length -= len(piece)
        check = zlib.crc32(piece, check)
        yield piece
    if check != _number(file.read(4)):
        raise NotPng("a chunk is broken")


def _number(content: bytes) -> int:
    if len(content) != 4:
        raise NotPng("it ends too early")
    return int.from_bytes(content, "big")


def _inflated(pieces: Iterator[bytes]) -> Iterator[bytes]:
    """Unpacked, never much at once."""
    inflater = zlib.decompressobj()
    for piece in pieces:
        rest = piece
        while rest and not inflater.eof:
            yield inflater.decompress(rest, PIECE_BYTES)
            rest = inflater.unconsumed_tail
    yield inflater.flush()


@dataclass(frozen=True)
class RowShape:
    """Of a row: pixels, and whether nothing stands above it."""

    width: int
    is_first: bool


def _rows(content: Iterator[bytes], header: Header) -> Iterator[tuple[int, bytes, RowShape]]:
    """The filter of each row, its filtered bytes, and its shape."""
    waiting = bytearray()
    for width, height in header.passes():
        length = 1 + -(-width * header.pixel_bits // 8)
        for number in range(height):
            while len(waiting) < length:
                piece = next(content, None)
                if piece is None:
                    raise NotPng("rows are missing")
                waiting += piece
            row = bytes(waiting[:length])
            del waiting[:length]
            yield row[0], row[1:], RowShape(width, is_first=not number)


@dataclass
class OneColourRows:
    """Whether all rows are of the colour of the first pixel.

    Where pixels are smaller than a byte, the last bits of a row may be anything. Its last byte is
    unfiltered, and only its pixels are compared.
    """

    header: Header
    pixel: bytes = b""
    last: int = 0
    """The last byte of the row above."""
    known: dict[tuple[int, RowShape], bytes] = field(default_factory=dict)

    def takes(self, way: int, row: bytes, shape: RowShape) -> bool:
        """One more row, filtered in this way. Raises NotPng."""
        if way > PAETH:
            raise NotPng("there is no such filter")
        self.pixel = self.pixel or self._first_pixel(row)
        if (way, shape) not in self.known:
            self.known[way, shape] = self._filtered(way, len(row), shape.is_first)
        wanted = self.known[way, shape]
        spare_bits = len(row) * 8 - shape.width * self.header.pixel_bits
        if not spare_bits:
            return row == wanted
        return row[:-1] == wanted[:-1] and self._ends_alike(way, row, shape, spare_bits)

    def _first_pixel(self, row: bytes) -> bytes:
        """No filter changes it. Of several pixels in a byte, the first one fills it."""
        bits = self.header.pixel_bits
        if bits >= 8:
            return row[: bits // 8]
        value = row[0] >> (8 - bits)
        return bytes([value * (255 // (2**bits - 1))])

    def _filtered(self, way: int, length: int, is_first: bool) -> bytes:
        """What the filter makes of a row that is all of this pixel, below such a row or none."""
        pixel = self.pixel
        left, other = pixel, pixel
        if way == SUB or (way == PAETH and is_first):
            other = bytes(len(pixel))
        elif way in (UP, PAETH) and not is_first:
            left = other = bytes(len(pixel))
        elif way == AVERAGE and is_first:
            other = bytes(value - value // 2 for value in pixel)
        elif way == AVERAGE:
            left, other = bytes(value - value // 2 for value in pixel), bytes(len(pixel))
        return left + other * (length // len(pixel) - 1)

    def _ends_alike(self, way: int, row: bytes, shape: RowShape, spare_bits: int) -> bool:
        value = self.pixel[0]
        beside = value if len(row) > 1 else 0
        above, corner = (0, 0) if shape.is_first else (self.last, beside)
        self.last = (row[-1] + _predicted(way, beside, above, corner)) % 256
        return (self.last ^ value) >> spare_bits == 0


def _predicted(way: int, left: int, above: int, corner: int) -> int:
    """The specification's five filters, for one byte."""
    plain = (0, left, above, (left + above) // 2)
    if way != PAETH:
        return plain[way]
    by_chance = left + above - corner
    return min((left, above, corner), key=lambda value: abs(by_chance - value))
