"""Builds the wheel of roslings (PEP 517): what `pip wheel .` calls.

The wheel is made from the students' edition, in a folder of its own, so that no answer can be in
it and nothing is left in the clone. It holds the engine as a package, the rest of the edition as
one archive in it, and each dependency group as an extra with the pins of constraints.txt.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import tarfile
import tempfile
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NoReturn

from setuptools import build_meta

from roslings.authoring.release import release
from roslings.bootstrap import constraints, groups
from roslings.bootstrap.place import Place
from roslings.installed import ARCHIVE, ENGINE

# In the folder that the wheel is built in there is nothing but what goes into it.
_SETUP = (
    "import setuptools\nsetuptools.setup(extras_require={extras!r}, package_data={{'': ['*']}})\n"
)


def build_wheel(
    wheel_directory: str,
    config_settings: Mapping[str, Any] | None = None,
    metadata_directory: str | None = None,
) -> str:
    """Write the wheel into `wheel_directory`; its file name.

    Raises CannotRelease where an answer would leak.
    """
    to = str(Path(wheel_directory).absolute())
    with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
        edition = Path(scratch).resolve() / "edition"
        release(edition)
        pack(edition)
        setup = _SETUP.format(extras=extras(Place(edition)))
        (edition / "setup.py").write_text(setup, "utf-8")
        with _in(edition):
            name: str = build_meta.build_wheel(to)
            return name


def build_sdist(sdist_directory: str, config_settings: object = None) -> NoReturn:
    """Refused: an sdist is the sources, and those hold the solutions."""
    raise NotImplementedError(
        "The sources hold the solutions, so there is no sdist. Build the wheel: pip wheel ."
    )


def extras(place: Place) -> dict[str, list[str]]:
    """Each dependency group with its pins, markers and all."""
    return {
        name: constraints.of_groups(place.constraints, [name])
        for name in groups.names(place.pyproject)
    }


def pack(edition: Path) -> None:
    """Put all of the edition but the engine into the archive, which lies in the engine."""
    archive = edition / ENGINE / ARCHIVE
    with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
        made = Path(scratch) / ARCHIVE
        with tarfile.open(made, "w:xz") as tar:
            for entry in sorted(edition.iterdir()):
                tar.add(entry, entry.name, filter=_plain)
        shutil.move(made, archive)


def _plain(entry: tarfile.TarInfo) -> tarfile.TarInfo | None:
    """Nobody's file, of one time: the same sources make the same archive."""
    if entry.name == ENGINE.as_posix():
        return None
    entry.uid = entry.gid = 0
    entry.uname = entry.gname = ""
    entry.mode = 0o755 if entry.isdir() or entry.mode & 0o100 else 0o644
    entry.mtime = int(os.environ.get("SOURCE_DATE_EPOCH") or time.time())
    return entry


@contextlib.contextmanager
def _in(folder: Path) -> Iterator[None]:
    """setuptools builds what lies where it stands."""
    before = Path.cwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)
