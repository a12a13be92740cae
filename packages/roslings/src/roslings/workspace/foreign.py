"""Read what a stranger's program has written: it may be a link, a pipe, or endless."""

from __future__ import annotations

import errno
import os
import shutil
import stat
from dataclasses import dataclass
from pathlib import Path

from roslings.arena.bounds import MB
from roslings.arena.isolation import ROOM_BYTES

MOST_BYTES = 1024 * 1024
PIECE_BYTES = 1024 * 1024
LEAST_BYTES = 4096
"""Of the disk, for anything that has a name."""


def read_foreign(path: Path, most_bytes: int = MOST_BYTES) -> bytes | None:
    """The beginning of a plain file; None where there is none, or something else in its place.

    Only the last part of `path` may be the stranger's.
    """
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    except OSError:
        return None
    with os.fdopen(descriptor, "rb") as file:
        found = os.fstat(descriptor)
        is_its_own = (
            stat.S_ISREG(found.st_mode) and found.st_nlink == 1
        )  # no name of another's file
        return file.read(most_bytes) if is_its_own else None


class NoRoom(OSError):
    """What is to be copied is more than the room held, or would take the last of the disk."""

    def __init__(self, place: Path, *, by_itself: bool) -> None:
        """`by_itself`: also on an empty disk."""
        super().__init__(errno.ENOSPC, "it takes more than it may", str(place))
        self.by_itself = by_itself


@dataclass
class Allowance:
    """How many bytes may be copied, as they are written: a sparse file has no holes afterwards."""

    most_bytes: int = ROOM_BYTES
    reserve_bytes: int = 512 * MB
    """So much of the disk stays free, for the evidence and the gradebook of everybody else."""
    copied_bytes: int = 0

    def take(self, count: int, place: Path) -> None:
        """So many more are written at `place`. Raises NoRoom."""
        self.copied_bytes += count
        is_too_much = self.copied_bytes > self.most_bytes
        if is_too_much or shutil.disk_usage(place.parent).free < self.reserve_bytes + count:
            raise NoRoom(place, by_itself=is_too_much)


def copy_foreign(folder: Path, to: Path, allowance: Allowance | None = None) -> None:
    """Copy plain files, folders and links to the new folder `to`; leave out the rest.

    What runs as its owner (set-user-ID) loses that. Whatever hinders the copy, nothing of it stays.
    Raises NoRoom, OSError.
    """
    allowance = allowance or Allowance()
    to.parent.mkdir(parents=True, exist_ok=True)
    try:
        waiting = [(folder, to)]
        while waiting:
            waiting += _copy_folder(*waiting.pop(), allowance)
    except BaseException:
        shutil.rmtree(to, ignore_errors=True)
        raise


def _copy_folder(folder: Path, to: Path, allowance: Allowance) -> list[tuple[Path, Path]]:
    """Copy what lies directly in it; returns the folders that it holds, and where they go."""
    allowance.take(LEAST_BYTES, to)
    to.mkdir(mode=0o755)
    inside = []
    with os.scandir(folder) as found:
        for entry in found:
            source, target = Path(entry.path), to / entry.name
            if entry.is_symlink():
                allowance.take(LEAST_BYTES, target)
                target.symlink_to(source.readlink())
            elif entry.is_dir():
                inside.append((source, target))
            elif entry.is_file():
                _copy_file(source, target, allowance)
    return inside


def _copy_file(source: Path, target: Path, allowance: Allowance) -> None:
    allowance.take(LEAST_BYTES, target)
    with source.open("rb") as original, target.open("xb") as copy:
        while piece := original.read(PIECE_BYTES):
            allowance.take(len(piece), target)
            copy.write(piece)
        runs = os.fstat(original.fileno()).st_mode & stat.S_IXUSR
    target.chmod(0o755 if runs else 0o644)
