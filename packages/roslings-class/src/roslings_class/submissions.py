"""Find the submissions: what was handed in, by whom, and when."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime, tzinfo
from pathlib import Path

from ros2_on_pip.safe_text import harmless
from roslings.hand_in.archives import SUFFIXES, is_archive, is_clutter
from roslings.workspace.errors import WorkspaceError
from roslings.workspace.sources import sources
from roslings_class.clock_times import as_time
from roslings_class.errors import BadTable, NoSubmissions
from roslings_class.platform_names import beside_a_file
from roslings_class.tables import TableRow, read_table

NAMES = ("submission", "student", "name", "id")
PATHS = ("path", "file", "folder", "archive")
TIMES = ("submitted", "time", "date")
"""Columns of a CSV file of submissions, the first that is there counts."""


@dataclass(frozen=True)
class Submission:
    """One thing that was handed in."""

    name: str
    """Of one submission only, and safe to show."""
    path: Path
    submitted: datetime | None = None
    """Known from a CSV file alone: a file's own date is often that of the download."""


def find_submissions(path: Path, zone: tzinfo | None = None) -> list[Submission]:
    """All submissions at `path`, by name: of a folder of them, a CSV file, or one alone.

    Times that name no zone are of `zone`. Raises NoSubmissions and BadTable.
    """
    if not path.exists():
        raise NoSubmissions(path, "there is nothing.")
    if path.is_file() and path.suffix.lower() == ".csv":
        found = list(_listed(path, zone))
    elif path.is_file() or (path / "package.xml").is_file():
        found = [Submission(name_of(path.absolute()), path)]
    else:
        found = list(_in_folder(path))
    if not found:
        raise NoSubmissions(path, "no submission is there.")
    return sorted(_with_own_names(found), key=lambda each: each.name)


def _in_folder(folder: Path) -> Iterator[Submission]:
    """Everything that lies there: who hands in the wrong kind of file is told so."""
    found = [entry for entry in folder.iterdir() if not _is_passed_by(entry.name)]
    remarks = beside_a_file(entry.name for entry in found)
    return (Submission(name_of(entry), entry) for entry in found if entry.name not in remarks)


def _is_passed_by(name: str) -> bool:
    return name.startswith(".") or is_clutter(name)


def name_of(path: Path) -> str:
    """The name of a file or folder without the ending of an archive."""
    name = path.name
    if not path.is_dir() and is_archive(path):
        ending = max((s for s in SUFFIXES if name.lower().endswith(s)), key=len)
        name = name[: -len(ending)]
    return harmless(name) or "submission"


def _with_own_names(found: list[Submission]) -> Iterator[Submission]:
    """`anna` and `anna.zip` are two: each keeps its whole name then, and a number at need."""
    taken: set[str] = set()
    for each in sorted(found, key=lambda each: os.fsencode(each.path)):
        name, number = each.name, 2
        while name in taken:
            name = f"{each.name} ({number})"
            number += 1
        taken.add(name)
        yield Submission(name, each.path, each.submitted)


# --- a CSV file --------------------------------------------------------------------------------


def _listed(table: Path, zone: tzinfo | None) -> Iterator[Submission]:
    for row in read_table(table):
        path = Path(row.needed(PATHS)).expanduser()
        name = row.first(NAMES)
        path = path if path.is_absolute() else table.parent / path
        yield Submission(harmless(name) if name else name_of(path), path, _time_in(row, zone))


def _time_in(row: TableRow, zone: tzinfo | None) -> datetime | None:
    text = row.first(TIMES)
    if not text:
        return None
    try:
        return as_time(text, zone)
    except ValueError:
        step = "Write it as 2026-11-30 23:59."
        raise BadTable(row.table, row.line, f"{text!r} is no date and time.", step) from None


# --- what is in it -----------------------------------------------------------------------------


def digest_of(path: Path) -> str:
    """A short name for the content: a submission that was handed in anew has another one."""
    content = hashlib.sha256()
    try:
        for piece in _pieces(path):
            content.update(piece)
    except (WorkspaceError, OSError) as error:
        content.update(type(error).__name__.encode())
    return content.hexdigest()[:32]


def _pieces(path: Path) -> Iterator[bytes]:
    if path.is_file():
        yield from _bytes_of(path)
    elif path.is_dir():
        for source in sources(path):
            yield os.fsencode(source.name) + b"\0" + str(source.link_to).encode() + b"\0"
            if source.link_to is None and source.path.is_file():
                yield from _bytes_of(source.path)


def _bytes_of(file: Path) -> Iterator[bytes]:
    with file.open("rb") as content:
        while chunk := content.read(1024 * 1024):
            yield chunk
