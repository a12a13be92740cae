"""Where a device of ours is when nobody says where: one known path, or a place of the user's own.

The labs' cards and tasks name a path in /tmp. One user of a computer can have that. For everybody
else, what lies there is a stranger's: a name in /tmp can only be taken away by its owner. So each
of the others gets a folder of their own, and stays with it.
"""

from __future__ import annotations

import os
import stat
import tempfile
from pathlib import Path

from roslings_rover.errors import DeviceTrouble

FOLDER = "roslings"


class NoOwnPlace(DeviceTrouble):
    """The user's own folder is not the user's."""

    def __init__(self, folder: Path, option: str) -> None:
        super().__init__(f"The folder {folder} is not yours. Give another place: {option}")


def known_place(name: str) -> Path:
    """The path that cards and tasks name."""
    return Path(tempfile.gettempdir()) / name


def usual_place(name: str, option: str) -> Path:
    """`known_place`, where it is free or ours; else one in a folder of this user's own.

    `option` is what gives the device another place. Raises NoOwnPlace.
    """
    known, own = known_place(name), own_folder()
    # The lock stays when the device ends, so its owner's board comes back to it.
    taken = any(map(_is_anothers, (known, Path(f"{known}.lock"))))
    if not taken and not own.exists():
        return known
    _make(own, option)
    return own / name


def own_folder() -> Path:
    """It goes when the user logs out, or when the computer starts anew."""
    of_session = os.environ.get("XDG_RUNTIME_DIR", "")
    if of_session and not _is_anothers(Path(of_session)) and Path(of_session).is_dir():
        return Path(of_session) / FOLDER
    return Path(tempfile.gettempdir()) / f"{FOLDER}-{os.getuid()}"


def told_of(place: Path, name: str, parameter: str) -> str:
    """What to give a node so that it finds the device there; empty where the known path is it."""
    known = known_place(name)
    if place == known:
        return ""
    why = f"{known} is another user's. " if _is_anothers(known) else ""
    return f"{why}Start your node with: --ros-args -p {parameter}:={place}"


def _is_anothers(path: Path) -> bool:
    try:
        return path.lstat().st_uid != os.getuid()
    except OSError:
        return False


def _make(folder: Path, option: str) -> None:
    """A folder that nobody else can write to or see into."""
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        found = folder.lstat()
    except OSError:
        raise NoOwnPlace(folder, option) from None
    private = stat.S_ISDIR(found.st_mode) and found.st_mode & 0o077 == 0
    if not private or found.st_uid != os.getuid():
        raise NoOwnPlace(folder, option)
