"""A folder for one run, gone when the run ends; one that a power cut left is swept later."""

from __future__ import annotations

import fcntl
import os
import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import IO

LOCK = "lock"
"""Held as long as the run lives. It is there before all else, and the last to go."""
UNLOCKED = "unlocked"
"""The same file before it is held."""
LOCKS = (LOCK, UNLOCKED)
MOST_TRIES, AGAIN_S = 20, 0.05


@contextmanager
def run_folder() -> Iterator[Path]:
    """A private folder, held by a lock that ends with this process."""
    sweep()
    folder, lock = _made()
    with lock:
        try:
            yield folder
        finally:
            _remove(folder)


def _made() -> tuple[Path, IO[str]]:
    """A new folder and its lock, held; made once more where somebody's sweep was quicker."""
    while True:
        folder = Path(tempfile.mkdtemp(prefix=_prefix()))
        with ExitStack() as closing, suppress(FileNotFoundError):
            lock = closing.enter_context((folder / UNLOCKED).open("w"))
            fcntl.flock(lock, fcntl.LOCK_EX)
            (folder / UNLOCKED).rename(folder / LOCK)  # a lock file in its place is always held
            closing.pop_all()
            return folder, lock


def sweep() -> None:
    """Remove folders of runs that were killed: their lock is free, or it is not there."""
    for folder in Path(tempfile.gettempdir()).glob(f"{_prefix()}*"):
        for name in LOCKS:
            with suppress(OSError), (folder / name).open("r+") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                _remove(folder)
        with suppress(OSError):
            folder.rmdir()
        if _inside(folder) and not (folder / LOCK).exists():
            _remove(folder)  # the lock came before all that is inside, so it was removed


def _remove(folder: Path) -> None:
    """The lock last: who is killed meanwhile leaves a folder that the next sweep knows.

    A process that is just being ended may write once more, after its folder was emptied.
    """
    for _ in range(MOST_TRIES):
        _open_all(folder)
        for entry in _inside(folder):
            with suppress(OSError):
                _remove_entry(entry)
        if not _inside(folder):
            shutil.rmtree(folder, ignore_errors=True)
        if not folder.exists():
            return
        time.sleep(AGAIN_S)


def _inside(folder: Path) -> list[Path]:
    """What lies there besides its locks."""
    try:
        return [entry for entry in folder.iterdir() if entry.name not in LOCKS]
    except OSError:
        return []


def _open_all(folder: Path) -> None:
    """A build may leave folders that not even their owner can write."""
    for path, names, _ in os.walk(folder):
        for each in (Path(path, name) for name in names):
            if not each.is_symlink():
                with suppress(OSError):
                    each.chmod(0o700)


def _remove_entry(entry: Path) -> None:
    if entry.is_dir() and not entry.is_symlink():
        shutil.rmtree(entry, ignore_errors=True)
    else:
        entry.unlink()


def is_abandoned(folder: Path) -> bool:
    """Whether the process that made a run's folder is gone: nobody holds its lock."""
    try:
        with (folder / LOCK).open("r+") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return True
    return True


def _prefix() -> str:
    return f"roslings-{os.getuid()}-"
