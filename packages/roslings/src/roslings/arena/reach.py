"""What a leased user may reach of the disk: listed, as in a sandbox, and held by Landlock.

Without Landlock, which is older kernels' lot, such a user reaches what everybody may.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

from roslings.arena.environment import HERE, LOOPBACK_ONLY, base_environment
from roslings.arena.sandbox import STAND_INS, SYSTEM, installations

Rule = tuple[str, int]
"""A folder or a file, and what may be done there and below."""

_VERSION_CALL, _ASK_VERSION = 444, 1
EXECUTE, WRITE_FILE, READ_FILE, READ_FOLDER = 1 << 0, 1 << 1, 1 << 2, 1 << 3
TRUNCATE = 1 << 14
READ = EXECUTE | READ_FILE | READ_FOLDER
ALL_SINCE = {1: (1 << 13) - 1, 2: 1 << 13, 3: TRUNCATE}
"""Rights by the version that brought them: linux/landlock.h. Those of devices stay as they are."""
SCOPES_SINCE, SCOPES = 6, 0b11
"""No signal to, and no abstract socket of, who is not confined with it."""
OPEN_TO_ALL = ("/tmp", "/var/tmp", "/dev/shm", "/dev/mqueue", "/run/lock")
"""Where every user may leave files; also in the rooms of programs that know no TMPDIR."""
SYSTEMS_OWN = ("/usr", *SYSTEM, "/etc", "/proc", "/sys", "/run/systemd/resolve")


@cache
def landlock_version() -> int:
    """Of this kernel; 0 where it has none, or does not use it."""
    if sys.platform != "linux":
        return 0
    found: int = ctypes.CDLL(None).syscall(_VERSION_CALL, None, ctypes.c_size_t(0), _ASK_VERSION)
    return max(0, found)


def everything(version: int) -> int:
    """All rights that this version knows."""
    return sum(rights for since, rights in ALL_SINCE.items() if since <= version)


def rules(own: Path, shown: Sequence[Path], closed: Sequence[str] = ()) -> list[Rule]:
    """For a user whose folders lie in `own`, and who is shown more. Empty without Landlock.

    Of the places where every user may leave files, the `closed` ones are out of reach.
    """
    if not (version := landlock_version()):
        return []
    places = [place for place in OPEN_TO_ALL if place not in closed]
    return [*_read(shown), *_written((*places, str(own)), everything(version), closed)]


def _read(shown: Sequence[Path]) -> Iterator[Rule]:
    for path in (*map(Path, SYSTEMS_OWN), *read_places(), *shown):
        if path.exists():
            yield str(path), READ if path.is_dir() else EXECUTE | READ_FILE


@cache
def read_places() -> tuple[Path, ...]:
    """Python, its packages and ROS, and of the engine what a node reads."""
    engine = (*STAND_INS, *HERE.glob("*.xml"), LOOPBACK_ONLY)
    return (*installations(base_environment(Path("/tmp"))), *engine)


def _written(places: Sequence[str], most: int, closed: Sequence[str]) -> Iterator[Rule]:
    in_devices = (READ_FILE | WRITE_FILE | READ_FOLDER | TRUNCATE) & most
    inside = [str(each) for each in Path("/dev").iterdir() if str(each) not in closed]
    for device in inside if any(place.startswith("/dev/") for place in closed) else ["/dev"]:
        yield device, in_devices if Path(device).is_dir() else in_devices & ~READ_FOLDER
    for place in places:
        if Path(place).is_dir():
            yield place, most


def within_reach(path: Path, closed: Sequence[str] = ()) -> bool:
    """Whether a leased user would see it, were it open to everybody."""
    if not landlock_version():
        return True
    left_open = [Path(place) for place in OPEN_TO_ALL if place not in closed]
    places = (*map(Path, SYSTEMS_OWN), *read_places(), *left_open)
    return any(path.is_relative_to(place.resolve()) for place in places)
