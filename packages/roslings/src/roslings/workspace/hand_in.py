"""The zip file to hand in."""

from __future__ import annotations

import os
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.typed_paths import shown
from roslings.workspace.errors import NoSuchPath, TargetAlreadyThere, reading, writing
from roslings.workspace.packages import package_name
from roslings.workspace.sources import files

BEGINNING_OF_TIME = (1980, 1, 1, 0, 0, 0)
"""The earliest date of the zip format. One date for all makes equal packages equal zips."""
UNIX = 3


@dataclass(frozen=True)
class Packed:
    """A zip that was written."""

    path: Path
    size_bytes: int
    files: tuple[str, ...]
    """Names in the zip, each with the package's name in front."""
    replaced: bool
    """An older zip of the same package had this name."""


def default_zip(lab: str, out: Path | None) -> Path:
    """Where the zip goes: `out`, or `LAB.zip` in the folder `out`, or in the current folder."""
    out = (out or Path()).expanduser().absolute()
    return out / f"{lab}.zip" if out.is_dir() else out


def write_zip(package: Path, out: Path) -> Packed:
    """Write the package's sources to the zip `out`; equal sources make an equal zip.

    Raises TargetAlreadyThere, NoSuchPath where the zip's folder is missing, and what `sources` and
    `writing` raise.
    """
    if not out.parent.is_dir():
        raise NoSuchPath(out.parent)
    name = package_name(package)
    replaced = _may_replace(out, name)
    contents = {name: path for name, path in files(package).items() if path != out.resolve()}
    with writing(out), _new_file(out) as new:
        with zipfile.ZipFile(new, "w", zipfile.ZIP_DEFLATED) as archive:
            for inside, path in sorted(contents.items()):
                _add(archive, f"{name}/{inside}", path)
        new.replace(out)
    inside_names = tuple(f"{name}/{inside}" for inside in sorted(contents))
    return Packed(out, out.stat().st_size, inside_names, replaced)


@contextmanager
def _new_file(out: Path) -> Iterator[Path]:
    """An empty file beside `out`, gone at the end of the block unless it took its place."""
    descriptor, name = tempfile.mkstemp(prefix=f".{out.name}-", dir=out.parent)
    os.close(descriptor)
    new = Path(name)
    try:
        new.chmod(0o644)
        yield new
    finally:
        with suppress(FileNotFoundError):
            new.unlink()


def _add(archive: zipfile.ZipFile, name: str, path: Path) -> None:
    """Add one file; of its permissions only that it may be run is kept."""
    info = zipfile.ZipInfo(name, BEGINNING_OF_TIME)
    info.compress_type = zipfile.ZIP_DEFLATED
    info.create_system = UNIX
    info.external_attr = (0o755 if path.stat().st_mode & 0o100 else 0o644) << 16
    with reading(path):
        archive.writestr(info, path.read_bytes())


def _may_replace(out: Path, name: str) -> bool:
    """Whether an older zip of the same package is there.

    Raises TargetAlreadyThere for anything else.
    """
    if not os.path.lexists(out):
        return False
    with suppress(OSError, zipfile.BadZipFile), zipfile.ZipFile(out) as old:
        if f"{name}/package.xml" in old.namelist():
            return True
    raise TargetAlreadyThere(
        f"{shown(out)}\nis there already, and is no zip of {name!r}. It stays as it is.",
        "Give another name: --out FILE",
    )
