"""Take a word out of this command's line in the list of processes, which every user can read."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Iterator
from pathlib import Path

COMMAND_LINE, STATUS = Path("/proc/self/cmdline"), Path("/proc/self/stat")
BEGINS_AT = 45
"""Of the numbers after the name in proc(5)'s stat: where the words of the command lie in memory."""


def unlist(path: Path) -> None:
    """Write `x` over it; what has read the words before keeps them.

    A program that began this one, `sudo` for example, has a list of its own.
    """
    if sys.platform != "linux":
        return
    begin = int(STATUS.read_text("utf-8", "replace").rpartition(")")[2].split()[BEGINS_AT])
    if begin:  # the kernel tells 0 to whom it tells nothing
        for at, size in _places(COMMAND_LINE.read_bytes(), path):
            ctypes.memset(begin + at, ord("x"), size)


def _places(line: bytes, path: Path) -> Iterator[tuple[int, int]]:
    """Where the path stands as a word, or as an option's value, and how long it is."""
    at = 0
    for word in line.split(b"\0"):
        value = word.partition(b"=")[2] if word.startswith(b"-") else word
        if value and Path(value.decode("utf-8", "surrogateescape")) == path:
            yield at + len(word) - len(value), len(value)
        at += len(word) + 1
