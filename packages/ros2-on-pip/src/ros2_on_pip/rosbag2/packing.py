"""Zstandard, the one compression that rosbag2 knows: of single messages, or of whole files."""

from __future__ import annotations

import shutil
import sys
from contextlib import suppress
from pathlib import Path

if sys.version_info >= (3, 14):
    from compression import zstd
else:
    from backports import zstd

ZSTD = "zstd"
ENDING = f".{ZSTD}"
MAGIC = b"\x28\xb5\x2f\xfd"
"""Begins whatever is compressed so (RFC 8878); a message of ROS never begins like that."""


def packed(data: bytes) -> bytes:
    """Fewer bytes, that say the same."""
    return bytes(zstd.compress(data))


def packed_file(file: Path) -> Path:
    """A compressed file, instead of `file`. Raises OSError."""
    place = file.with_name(file.name + ENDING)
    pack_file(file, place)
    file.unlink()
    return place


def unpack_file(file: Path, place: Path) -> None:
    """Write what a compressed file holds to `place`; of one that was cut off, what is left.

    Raises OSError, zstd.ZstdError.
    """
    with zstd.open(file, "rb") as stream, place.open("wb") as out, suppress(EOFError):
        shutil.copyfileobj(stream, out)


def pack_file(plain: Path, place: Path) -> None:
    """The other way round. Raises OSError."""
    with plain.open("rb") as stream, zstd.open(place, "wb") as out:
        shutil.copyfileobj(stream, out)


BROKEN = zstd.ZstdError
"""What was compressed is damaged."""
