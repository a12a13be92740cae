"""Builds the wheel of roslings (PEP 517): what `pip wheel packages/roslings` calls.

The wheel is made from the students' edition, in a folder of its own. So no answer can be in it, and
nothing is left in the clone. It holds the edition's packages, so that one name is enough to
install, and the whole edition as one archive. It holds each dependency group as an extra with the
pins of constraints.txt. `roslings[class]` brings what instructors have besides.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import tarfile
import tempfile
import time
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any, NoReturn

from setuptools import build_meta

from roslings_class.description import address, for_its_page, urls
from roslings_class.release import release
from roslings_launcher import __version__, constraints, groups
from roslings_launcher.installed import ARCHIVE
from roslings_launcher.place import CoursePlace
from roslings_launcher.sources import OFFERS, offers, source_folders

ENGINE = "roslings"
"""The package of that name, and the distribution."""
FOR_INSTRUCTORS = ("roslings-class", "roslings-prove")
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

    Raises CannotRelease where an answer would leak, and NoAddress.
    """
    address()  # asked for before anything is made
    with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
        edition = Path(scratch).resolve() / "edition"
        release(edition)
        return wheel_of(edition, Path(wheel_directory).absolute())


def wheel_of(edition: Path, to: Path) -> str:
    """Write the wheel of a students' edition into the folder `to`; its file name.

    Raises NoAddress.
    """
    with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
        made = Path(scratch).resolve() / "made"
        lay_out(edition, made)
        with _in(made):
            name: str = build_meta.build_wheel(str(to))
            return name


def build_sdist(sdist_directory: str, config_settings: object = None) -> NoReturn:
    """Refused: an sdist is the sources, and those hold the solutions."""
    raise NotImplementedError(
        "The sources hold the solutions, so there is no sdist.\n"
        "Build the wheel: pip wheel packages/roslings"
    )


def extras(place: CoursePlace) -> dict[str, list[str]]:
    """Each dependency group with its pins, markers and all; and what instructors have besides."""
    pinned = {
        name: constraints.of_groups(place.constraints, [name])
        for name in groups.names(place.pyproject)
    }
    return {**pinned, "class": [f"{name}=={__version__}" for name in FOR_INSTRUCTORS]}


def lay_out(edition: Path, made: Path) -> None:
    """Put what goes into the wheel into the new folder `made`."""
    for folder in source_folders(edition):
        shutil.copytree(folder, made / "src", dirs_exist_ok=True)
    describe(edition, made, address())
    (made / OFFERS).write_text(offers(edition), "utf-8")
    (made / "setup.py").write_text(_SETUP.format(extras=extras(CoursePlace(edition))), "utf-8")
    pack(edition, made / "src" / ENGINE / ARCHIVE)


def describe(edition: Path, made: Path, at: str) -> None:
    """Put what the wheel says of itself, and the licences, into `made`."""
    own = PurePosixPath("packages", ENGINE)
    readme = (edition / own / "README.md").read_text("utf-8")
    (made / "README.md").write_text(for_its_page(readme, own, at), "utf-8")
    project = (edition / own / "pyproject.toml").read_text("utf-8")
    (made / "pyproject.toml").write_text(project + urls(at), "utf-8")
    for licence in edition.glob("LICENSE*"):
        shutil.copy(licence, made)


def pack(edition: Path, archive: Path) -> None:
    """Put all of the edition into the archive."""
    with tarfile.open(archive, "w:xz") as tar:
        for entry in sorted(edition.iterdir()):
            tar.add(entry, entry.name, filter=_plain)


def _plain(entry: tarfile.TarInfo) -> tarfile.TarInfo:
    """Nobody's file, of one time: the same sources make the same archive."""
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
