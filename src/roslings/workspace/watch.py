"""Tell when a student saves a file."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from watchfiles import BaseFilter, Change, watch

from roslings.workspace.sources import BUILT, MADE

SETTLED_MS = 400
"""An editor saves a file in several steps; they are told as one change."""
STEP_MS = 100
LOOK_AGAIN_MS = 1000
_EDITORS = re.compile(
    r"^\.|~$|^#.*#$|\.py[co]$|\.tmp$|\.swp$|^4913$|___jb_(tmp|old)___$|\.kate-swp$|\.bak$"
)
"""Files that an editor makes for itself; 4913 is Vim's test of whether it may write."""


class Saves(BaseFilter):
    """Lets through what a student saves, and nothing that tools and editors make."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        super().__init__()

    def __call__(self, change: Change, path: str) -> bool:
        """Whether the change of `path` is one that counts."""
        try:
            parts = Path(path).relative_to(self._folder).parts
        except ValueError:
            return False
        if not parts or parts[0] in BUILT:
            return False
        return not any(part in MADE or _EDITORS.search(part) for part in parts)


def changes(folder: Path, stop: Callable[[], bool] = lambda: False) -> Iterator[frozenset[Path]]:
    """The paths of each save under `folder`, until Ctrl-C or until `stop()` is true.

    A folder that vanishes (git checkout, a rename) is waited for; when it is back, that is a
    change of the folder itself. While the caller works on one set, later saves are kept for the
    next.
    """
    folder = folder.resolve()
    try:
        yield from _changes(folder, stop)
    except KeyboardInterrupt:
        return


def _changes(folder: Path, stop: Callable[[], bool]) -> Iterator[frozenset[Path]]:
    while not stop():
        identity = _identity(folder)
        if identity is None:
            time.sleep(STEP_MS / 1000)
            continue
        yield from _while_it_stays(folder, identity, stop)
        if not stop() and _back(folder, stop):
            yield frozenset({folder})


def _while_it_stays(
    folder: Path, identity: int, stop: Callable[[], bool]
) -> Iterator[frozenset[Path]]:
    """Saves under `folder`, as long as it is the folder that it was."""
    try:
        for found in _watch(folder):
            if stop() or _identity(folder) != identity:
                return
            if found:
                yield frozenset(Path(path) for _, path in found)
    except FileNotFoundError:  # gone before the watch began
        return


def _watch(folder: Path) -> Iterator[set[tuple[Change, str]]]:
    return watch(
        folder,
        watch_filter=Saves(folder),
        debounce=SETTLED_MS,
        step=STEP_MS,
        rust_timeout=LOOK_AGAIN_MS,
        yield_on_timeout=True,
    )


def _identity(folder: Path) -> int | None:
    """What tells this folder from a later one of the same name; None while there is none."""
    try:
        return folder.stat().st_ino
    except OSError:
        return None


def _back(folder: Path, stop: Callable[[], bool]) -> bool:
    """Wait until there is a folder again; False where the wait was ended."""
    while _identity(folder) is None:
        if stop():
            return False
        time.sleep(STEP_MS / 1000)
    return True
