"""Read what a stranger's program has written: it may be a link, a pipe, or endless."""

from __future__ import annotations

import os
import shutil
import stat
from pathlib import Path

MOST_BYTES = 1024 * 1024


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


def copy_foreign(folder: Path, to: Path) -> None:
    """Copy plain files, folders and links as they are; leave out the rest.

    What runs as its owner (set-user-ID) loses that. Raises OSError, shutil.Error.
    """
    shutil.copytree(folder, to, symlinks=True, ignore=_special, copy_function=_copy_plain)


def _special(folder: str, names: list[str]) -> list[str]:
    kinds = (stat.S_ISREG, stat.S_ISDIR, stat.S_ISLNK)
    modes = {name: os.lstat(os.path.join(folder, name)).st_mode for name in names}  # noqa: PTH118
    return [name for name, mode in modes.items() if not any(is_kind(mode) for is_kind in kinds)]


def _copy_plain(source: str, target: str) -> None:
    shutil.copyfile(source, target, follow_symlinks=False)
    if not os.path.islink(target):  # noqa: PTH114
        runs = os.stat(source).st_mode & stat.S_IXUSR  # noqa: PTH116
        os.chmod(target, 0o755 if runs else 0o644)  # noqa: PTH101
