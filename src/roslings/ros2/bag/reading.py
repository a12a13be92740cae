"""Open a bag, with words for what can be wrong with it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from roslings.ros2.problem import Problem


class NoBag(Problem):
    """There is no bag at the path, or it is damaged."""

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(
            f"[ERROR] [ros2bag]: no bag can be read at '{path}': {reason}."
            " A bag is a folder with metadata.yaml in it; give the path of that folder."
        )


@contextmanager
def opened(path: Path) -> Iterator[Any]:
    """A `rosbags` reader of the bag at `path`. Raises NoBag."""
    from rosbags.rosbag2 import Reader, ReaderError

    if not path.exists():
        raise NoBag(path, "there is nothing of that name")
    try:
        reader = Reader(path)
        reader.open()
    except (ReaderError, OSError, ValueError, KeyError) as fault:
        raise NoBag(path, _first_line(fault)) from fault
    try:
        yield reader
    finally:
        reader.close()


def _first_line(fault: Exception) -> str:
    return (str(fault) or type(fault).__name__).splitlines()[0].rstrip(".")
