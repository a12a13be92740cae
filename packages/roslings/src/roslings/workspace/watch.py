"""Tell when a student saves a file."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from watchfiles import BaseFilter, Change, watch

from roslings.workspace.sources import BUILT, MADE

SETTLED_MS = 400
"""An editor saves a file in several steps; they are told as one change."""
STEP_MS = 100
LOOK_AGAIN_MS = 100
"""How long a key waits at most."""
_ENDINGS = "py|xml|cfg|yaml|yml|txt|md|sh|json|msg|srv|action|launch"
_EDITORS = re.compile(
    "|".join(
        (
            r"^\.",  # hidden: Vim's swap files, gedit's and nano's new ones, Emacs's locks
            r"~$",
            r"^#.*#$",
            r"\.py[co]$",
            r"\.(tmp|temp|swp|swo|swx|bak|bck|old|orig|rej|part|lock)$",
            r"\.(tmp|temp)[.\d-]",
            r"^4913$",  # Vim's test of whether it may write
            r"___jb_(tmp|old)___$",  # PyCharm
            r"\.kate-swp$",
            rf"\.({_ENDINGS})\.[A-Za-z0-9]{{6}}$",  # Kate, and all that Qt saves
            r"\.sb-[0-9a-f]+-\w+$",  # macOS
            r"^(flycheck|flymake)_|_(flycheck|flymake)\.\w+$",  # Emacs
            r"^sed[A-Za-z0-9]{6}$",  # sed -i
            r"\.yours\d*$",  # ours: what a drill was before it was begun again
        )
    )
)
"""Files that an editor makes for itself."""


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


def never() -> bool:
    """Nothing stops it, and nothing wakes it."""
    return False


def changes(
    folder: Path,
    stop: Callable[[], bool] = never,
    begin: bool = False,
    wake: Callable[[], bool] = never,
) -> Iterator[frozenset[Path]]:
    """The paths of each save under `folder`, until Ctrl-C or until `stop()` is true.

    Saves that come while the caller works on one set are kept for the next. With `begin`, the
    first set is empty and comes as soon as the watch has begun: who works on it misses nothing.
    An empty set comes, too, as often as `wake()` is true.
    A folder may vanish (git checkout, a rename), or this user may no longer read it. That is told
    as a change of the folder itself, and waited for. That it is back is another such change.
    """
    folder = folder.resolve()
    try:
        yield from _changes(folder, stop, begin, wake)
    except KeyboardInterrupt:
        return


def _changes(
    folder: Path, stop: Callable[[], bool], begin: bool, wake: Callable[[], bool]
) -> Iterator[frozenset[Path]]:
    at_first: frozenset[Path] | None = frozenset() if begin else None
    while not stop():
        if not _can_be_watched(folder):
            yield from _told_as_gone(folder, stop, wake)
            at_first = frozenset({folder})
            continue
        with _held(folder) as is_still_there:
            for found in _watch(folder):
                if stop() or not is_still_there():
                    break
                if found or at_first is not None or wake():
                    yield frozenset(Path(path) for _, path in found) | (at_first or frozenset())
                    at_first = None
        at_first = frozenset({folder})  # told when the new watch has begun: no save is missed


def _watch(folder: Path) -> Iterator[set[tuple[Change, str]]]:
    """Changes, and an empty set now and then; ends at once where the folder is gone."""
    with suppress(FileNotFoundError, NotADirectoryError, PermissionError):
        yield from watch(
            folder,
            watch_filter=Saves(folder),
            debounce=SETTLED_MS,
            step=STEP_MS,
            rust_timeout=LOOK_AGAIN_MS,
            yield_on_timeout=True,
            ignore_permission_denied=True,
        )


@contextmanager
def _held(folder: Path) -> Iterator[Callable[[], bool]]:
    """A function that tells whether the path still means the folder that it means now.

    The folder is held open meanwhile: otherwise a new one could get the number of the old.
    """
    try:
        held = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    except (FileNotFoundError, NotADirectoryError, PermissionError):
        yield lambda: False
        return
    try:
        yield lambda: _identity(folder) == _identity(held) and _can_be_watched(folder)
    finally:
        os.close(held)


def _identity(folder: Path | int) -> tuple[int, int] | None:
    try:
        found = os.stat(folder)  # noqa: PTH116 - of a path or of an open folder
    except OSError:
        return None
    return found.st_dev, found.st_ino


def _can_be_watched(folder: Path) -> bool:
    return folder.is_dir() and os.access(folder, os.R_OK | os.X_OK)


def _told_as_gone(
    folder: Path, stop: Callable[[], bool], wake: Callable[[], bool]
) -> Iterator[frozenset[Path]]:
    """Tell it once, and then wait until the folder is there; keys are heard meanwhile."""
    yield frozenset({folder})
    while not stop() and not _can_be_watched(folder):
        if wake():
            yield frozenset()
        time.sleep(STEP_MS / 1000)
