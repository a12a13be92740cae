"""Script: become an ordinary user, who can read the Python that runs these tests.

    unshare --mount python -I -S as_ordinary.py UID FOLDER ... [--hide=FOLDER] -- COMMAND ...

A Python often lies below somebody's home, which other users may not enter. In a mount namespace
that is ours alone, such a home is replaced by an empty folder that shows just the folders named.
Nothing of it is seen outside, and nothing is changed on disk. A hidden folder is empty there.
"""

import ctypes
import os
import sys
import tempfile
from pathlib import Path

MS_BIND, MS_REC, MS_PRIVATE = 4096, 16384, 1 << 18
HIDE = "--hide="
libc = ctypes.CDLL(None, use_errno=True)


def mount(source: str | None, target: str, kind: str | None, flags: int, options: str = "") -> None:
    """mount(2). Raises OSError."""
    words = [each.encode() if each else None for each in (source, target, kind)]
    if libc.mount(*words, flags, options.encode() or None) == -1:
        raise OSError(ctypes.get_errno(), f"mount {target}")


def closed_above(folder: Path) -> Path | None:
    """The first folder on the way that others may not enter."""
    way = [*reversed(folder.parents), folder]
    return next((each for each in way if not each.stat().st_mode & 0o001), None)


def show(folders: list[Path]) -> None:
    """Let everybody read these folders, in this mount namespace."""
    mount(None, "/", None, MS_REC | MS_PRIVATE)
    by_home: dict[Path, list[Path]] = {}
    for folder in folders:
        if home := closed_above(folder):
            by_home.setdefault(home, []).append(folder)
    for home, inside in by_home.items():
        _replace(home, inside)


def _replace(home: Path, inside: list[Path]) -> None:
    """What is tidied in the end is empty folders, one by one: never what is mounted there."""
    name = Path(tempfile.mkdtemp())
    held = [name / str(number) for number in range(len(inside))]
    for folder, place in zip(inside, held):  # noqa: B905
        place.mkdir()
        mount(str(folder), str(place), None, MS_BIND | MS_REC)
    mount("tmpfs", str(home), "tmpfs", 0, "mode=0755")
    for folder, place in zip(inside, held):  # noqa: B905
        folder.mkdir(parents=True, exist_ok=True)
        mount(str(place), str(folder), None, MS_BIND | MS_REC)
        libc.umount2(str(place).encode(), 2)
        place.rmdir()
    name.rmdir()


def main(uid: int, words: list[str], command: list[str]) -> None:
    """Show, hide, drop, run."""
    hidden = [word[len(HIDE) :] for word in words if word.startswith(HIDE)]
    show([Path(word).resolve() for word in words if not word.startswith(HIDE)])
    for folder in hidden:
        mount("tmpfs", folder, "tmpfs", 0, "mode=0755")
    os.setgroups([])
    os.setgid(uid)
    os.setuid(uid)
    os.execvp(command[0], command)


if __name__ == "__main__":
    end = sys.argv.index("--")
    main(int(sys.argv[1]), sys.argv[2:end], sys.argv[end + 1 :])
