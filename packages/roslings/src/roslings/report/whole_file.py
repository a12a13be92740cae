"""Write a file whole or not at all: a full disk or Ctrl-C leaves the old one as it was."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

from ros2_on_pip.errors import INCONCLUSIVE, RoslingsError
from ros2_on_pip.typed_paths import from_here, quoted_from_here


class CannotWriteFile(RoslingsError):
    """A file could not be written; the message says why and what to do."""

    exit_status = INCONCLUSIVE

    def __init__(self, path: Path, error: OSError) -> None:
        self.path = path
        reason = error.strerror or str(error)
        super().__init__(f"Cannot write {from_here(path)}: {reason}. {_next_step(path, error)}")


def _next_step(path: Path, error: OSError) -> str:
    if isinstance(error, FileNotFoundError):
        return f"Make the folder first: mkdir -p {quoted_from_here(path.parent)}"
    if isinstance(error, IsADirectoryError):
        return "Give the name of a file in it."
    return "Free some space, or give a place where you may write."


def write_whole(path: Path, content: bytes, *, overwrite: bool = True) -> None:
    """Put `content` at `path` in one step.

    Raises CannotWriteFile, and FileExistsError where `overwrite` is false and the file is there.
    """
    if not overwrite and path.exists():
        raise already_there(path)
    try:
        _write(path, content, overwrite)
    except FileExistsError:
        raise already_there(path) from None
    except OSError as error:
        raise CannotWriteFile(path, error) from error


def make_folder_of(path: Path) -> None:
    """Make the folder that `path` lies in. Raises CannotWriteFile."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CannotWriteFile(path, error) from error


def already_there(path: Path) -> FileExistsError:
    """The refusal to overwrite, with the next step."""
    return FileExistsError(
        f"{from_here(path)} is there already. Give another name, or remove it first."
    )


def _write(path: Path, content: bytes, overwrite: bool) -> None:
    target = path.resolve()  # a link stays a link: what it points to is replaced
    if target.is_dir():
        raise IsADirectoryError(None, "this is a folder")
    if target.exists() and not target.is_file():
        # /dev/null, a pipe: renaming over it would destroy it.
        target.write_bytes(content)
        return
    with _beside(target) as part:
        part.write_bytes(content)
        _put(part, target, overwrite)


@contextlib.contextmanager
def _beside(target: Path) -> Iterator[Path]:
    """A name in the same folder, so that the rename is atomic; nothing stays there afterwards."""
    part = target.with_name(f".roslings-{os.getpid()}.part")
    try:
        yield part
    finally:
        part.unlink(missing_ok=True)


def _put(part: Path, target: Path, overwrite: bool) -> None:
    if overwrite:
        part.replace(target)
        return
    try:
        os.link(part, target)  # fails where a file appeared meanwhile
    except FileExistsError:
        raise
    except OSError:  # a file system without hard links, e.g. a USB stick
        part.replace(target)
