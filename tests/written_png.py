"""Pictures as bytes, right or hostile: a PNG file is a signature and chunks (ISO/IEC 15948)."""

from __future__ import annotations

import struct
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"

Chunk = tuple[bytes, bytes]
"""Its kind, and its content."""


def head_of(width: int, height: int, depth: int = 8, colour: int = 2, interlace: int = 0) -> Chunk:
    """The first chunk: pixels, bits of a sample, and the number of the kind of colour."""
    return b"IHDR", struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, interlace)


def png_of(*chunks: Chunk) -> bytes:
    """A file of these chunks, whether they fit each other or not."""
    return SIGNATURE + b"".join(map(_written, chunks))


def _written(chunk: Chunk) -> bytes:
    kind, content = chunk
    check = struct.pack(">I", zlib.crc32(kind + content))
    return struct.pack(">I", len(content)) + kind + content + check
