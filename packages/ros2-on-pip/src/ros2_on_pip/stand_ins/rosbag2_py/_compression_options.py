"""Whether single messages are compressed, or whole files."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class CompressionMode(Enum):
    """What is compressed."""

    NONE = 0
    FILE = 1
    MESSAGE = 2


@dataclass
class CompressionOptions:
    """How; the format is always `zstd`."""

    compression_format: str = ""
    compression_mode: CompressionMode = CompressionMode.NONE
    compression_queue_size: int = 1
    compression_threads: int = 0


def compression_mode_from_string(text: str) -> CompressionMode:
    """The mode of this name, in letters of any size; NONE where there is none."""
    return CompressionMode.__members__.get(text.upper(), CompressionMode.NONE)


def compression_mode_to_string(mode: CompressionMode) -> str:
    """Its name."""
    return mode.name
