"""The folder of a submission in the `--out` folder, called as the submission is."""

from __future__ import annotations

import re
import unicodedata
import zlib
from pathlib import Path

STUDENTS, PAGE = "students", "report.html"
LONGEST_NAME = 60
"""In characters; of four bytes each, with the number behind it, that is less than 255 bytes."""
_UNSAFE = re.compile(r"[^\w .,'()@+-]")
"""Letters of any language stay. What a file system, a shell's wildcard or an address may not hold
becomes `_`."""
_OF_BEFORE = re.compile(r"[^\w-]+", re.ASCII)


def folder_of(out: Path, submission: str) -> Path:
    """Where the page and the files of a submission lie; `out` is the gradebook's folder."""
    return out / STUDENTS / folder_name(submission)


def folder_name(submission: str) -> str:
    """The folder of a submission; one of its own, whatever the submission is called."""
    safe = _UNSAFE.sub("_", unicodedata.normalize("NFC", submission))
    safe = safe[:LONGEST_NAME].strip(" .-")
    return safe if safe == submission else _numbered(safe, submission)


def _numbered(safe: str, submission: str) -> str:
    return f"{safe or 'submission'}-{zlib.crc32(submission.encode('utf-8', 'replace')):08x}"


def bring_over(folder: Path, submission: str) -> None:
    """A folder of before, in whose name only ASCII letters were, gets the name of today."""
    safe = _OF_BEFORE.sub("_", submission).strip("_")[:LONGEST_NAME]
    before = folder / (safe if safe == submission else _numbered(safe, submission))
    today = folder / folder_name(submission)
    if before.is_dir() and not today.exists():
        before.rename(today)
