"""Copy a package: whole or not at all, and never over something that is there."""

from __future__ import annotations

import os
import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ros2_on_pip.typed_paths import shown
from roslings.workspace.errors import TargetAlreadyThere, reading, writing
from roslings.workspace.sources import PackageLimits, PackageSource, sources

HALF_MADE = ".roslings-half-made-"
"""Hidden, so that colcon does not look into it."""
STALE_S = 3600.0


def copy_package(package: Path, into: Path, limits: PackageLimits | None = None) -> Path:
    """Copy the sources of `package` to the new folder `into`; returns `into`.

    The package is only read. Folders above `into` are made. Whatever interrupts the copy, `into` is
    there and whole, or not there. Raises TargetAlreadyThere where something stands at `into`, and
    what `sources` and `writing` raise.
    """
    found = list(sources(package, limits))
    with writing(into), _half_made(into) as folder:
        for source in found:
            _copy(source, folder / source.name)
        _put(folder, into)
    return into


@contextmanager
def _half_made(into: Path) -> Iterator[Path]:
    """An empty folder beside `into`, gone at the end of the block unless it was put in place."""
    made = _make_parents(into)
    folder = None
    try:
        _sweep(into.parent)
        folder = Path(tempfile.mkdtemp(prefix=HALF_MADE, dir=into.parent))
        folder.chmod(0o755 & ~_umask())
        yield folder
    finally:
        if folder:
            shutil.rmtree(folder, ignore_errors=True)
        for parent in made:
            with suppress(OSError):  # not empty: it holds what was put in place
                parent.rmdir()


def _make_parents(into: Path) -> list[Path]:
    """Make the folders above `into`; returns those that were not there, deepest first."""
    missing = [parent for parent in into.parents if not parent.exists()]
    into.parent.mkdir(parents=True, exist_ok=True)
    return missing


def _sweep(folder: Path) -> None:
    """Remove what a copy left that was killed, long ago."""
    for stale in folder.glob(f"{HALF_MADE}*"):
        with suppress(OSError):
            if time.time() - stale.stat().st_mtime > STALE_S:
                shutil.rmtree(stale, ignore_errors=True)


def _umask() -> int:
    mask = os.umask(0o022)
    os.umask(mask)
    return mask


def _copy(source: PackageSource, to: Path) -> None:
    if source.link_to is not None:
        to.symlink_to(source.link_to)
    elif source.is_folder:
        to.mkdir()
    else:
        _copy_file(source.path, to)


def _copy_file(path: Path, to: Path) -> None:
    with reading(path), path.open("rb") as original, to.open("wb") as copy:
        shutil.copyfileobj(original, copy)
    to.chmod(path.stat().st_mode & 0o777 | 0o600)


def _put(folder: Path, into: Path) -> None:
    """Give the finished folder its name. An empty folder of that name may give way."""
    try:
        folder.rename(into)
    except OSError:
        if not os.path.lexists(into):
            raise
        raise TargetAlreadyThere(
            f"There is something at {shown(into)}. It stays as it is.",
            "Move it away first, or choose another place.",
        ) from None
