"""The one zip file that a learning platform makes of a whole class, given as it was downloaded."""

from __future__ import annotations

import posixpath
import re
import zipfile
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import tzinfo
from pathlib import Path

from ros2_on_pip.typed_paths import from_here
from roslings.experiment.run_folder import run_folder
from roslings.hand_in.archives import SUFFIXES, UnpackBudget, is_clutter, unpack, zip_names
from roslings.hand_in.errors import HandInRefused, HostileArchive
from roslings.workspace.packages import LARGEST_BYTES, NAME
from roslings.workspace.sources import PackageLimits
from roslings_class.errors import BatchError
from roslings_class.platform_names import platform_name
from roslings_class.roster import Student
from roslings_class.submissions import Submission, find_submissions, name_of

WHOLE_CLASS = PackageLimits(bytes=20_000_000_000, files=500_000)
"""The instructor's own download; each submission in it has its own bounds later."""
UNPACK_IT = "Unpack it yourself, and give the folder that comes out."


@contextmanager
def submissions_at(
    path: Path, students: Sequence[Student] = (), zone: tzinfo | None = None
) -> Iterator[list[Submission]]:
    """What was handed in at `path`; the download of a class is unpacked for as long as the block.

    Times in a CSV file that name no zone are of `zone`. Raises BatchError.
    """
    download = _download_at(path, students)
    if download is None:
        yield find_submissions(_inner(path, students), zone)
        return
    with run_folder() as room:
        yield find_submissions(_inner(_unpacked(download, room / "downloaded"), students))


def _download_at(path: Path, students: Sequence[Student]) -> Path | None:
    """The download of a class: `path`, or the only thing in that folder; None where it is none."""
    inside = _entries(path) if path.is_dir() else [path]
    if len(inside) != 1 or not inside[0].is_file() or _is_of_one(inside[0], students):
        return None
    return inside[0] if is_download(inside[0]) else None


def _is_of_one(path: Path, students: Sequence[Student]) -> bool:
    """One student's, who may put files into it that are called like others' hand-ins.

    It has a platform's name, or the whole name of somebody in the class list; or it is a clone.
    """
    name = name_of(path)
    told = platform_name(path.name) or platform_name(name)
    is_clone = (path / ".git").exists()
    return told is not None or is_clone or any(student.is_called(name) for student in students)


def _inner(folder: Path, students: Sequence[Student]) -> Path:
    """A folder that holds nothing but the folder with the platform's names is that one."""
    inside = _entries(folder) if folder.is_dir() else []
    if len(inside) == 1 and inside[0].is_dir() and not _is_of_one(inside[0], students):
        deeper = _inner(inside[0], students)
        if deeper != inside[0] or _is_of_a_class([entry.name for entry in _entries(deeper)]):
            return deeper
    return folder


def _entries(folder: Path) -> list[Path]:
    return [e for e in folder.iterdir() if not is_clutter(e.name) and not e.name.startswith(".")]


def _unpacked(download: Path, into: Path) -> Path:
    try:
        unpack(download, into, UnpackBudget(WHOLE_CLASS))
    except (HostileArchive, HandInRefused) as refusal:
        raise BatchError(f"{from_here(download)}: {refusal.reason}", UNPACK_IT) from refusal
    return _without_wrapper(into)


def _without_wrapper(folder: Path) -> Path:
    """Whoever packs a folder again gets one more around it."""
    inside = _entries(folder)
    if len(inside) == 1 and inside[0].is_dir() and not platform_name(inside[0].name):
        return _without_wrapper(inside[0])
    return folder


# --- is it one? --------------------------------------------------------------------------------


def is_download(file: Path) -> bool:
    """Whether a zip file holds the work of several students, or has a platform's names in it.

    Raises BatchError where it holds too many files.
    """
    try:
        names = _unwrapped(zip_names(file, WHOLE_CLASS))
    except HostileArchive as hostile:
        raise BatchError(f"{from_here(file)}: {hostile.reason}", UNPACK_IT) from hostile
    tops = {name.partition("/")[0] for name in names}
    packed = {name.partition("/")[0] for name in names if name.lower().endswith(SUFFIXES)}
    return _is_of_a_class(tops) or len(packed) > 1 or _has_a_package_twice(file, names)


def _is_of_a_class(names: set[str] | list[str]) -> bool:
    """One name that is a platform's for certain, or nothing but names that may be."""
    told = [platform_name(name_of(Path(name))) or platform_name(name) for name in names]
    certain = any(each and each.is_certain for each in told)
    return certain or (bool(told) and all(told))


def _unwrapped(names: dict[str, zipfile.ZipInfo]) -> dict[str, zipfile.ZipInfo]:
    """Without the folders that are around all of it, up to the platform's names."""
    around = posixpath.commonpath([posixpath.dirname(name) for name in names]) if names else ""
    parts = around.split("/") if around else []
    made = next((at for at, part in enumerate(parts) if platform_name(part)), len(parts))
    return {"/".join(name.split("/")[made:]): info for name, info in names.items()}


def _has_a_package_twice(file: Path, names: dict[str, zipfile.ZipInfo]) -> bool:
    """Two students' packages have one name; those of one workspace have several."""
    sheets = [
        info
        for name, info in names.items()
        if "/" in name and posixpath.basename(name) == "package.xml"
    ]
    try:
        with zipfile.ZipFile(file) as archive:
            found = Counter(_package_in(archive, sheet) for sheet in sheets[:2_000])
    except (zipfile.BadZipFile, OSError, RuntimeError, NotImplementedError, EOFError):
        return False
    return any(count > 1 for name, count in found.items() if name)


def _package_in(archive: zipfile.ZipFile, sheet: zipfile.ZipInfo) -> str:
    with archive.open(sheet) as content:
        start = content.read(LARGEST_BYTES["package.xml"])
        found = re.search(NAME, start.decode("utf-8", "replace"))
    return found[1] if found else ""
