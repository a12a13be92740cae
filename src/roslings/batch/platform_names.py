"""What learning platforms call a student's files when an instructor downloads them all.

Moodle (its assignment, "Download all submissions"): `Full Name_NUMBER_assignsubmission_PART`, a
folder, or the start of a file's name where the instructor chose no folders. PART is `file` or
`onlinetext`; older ones end with a line low. NUMBER is that of the grading worksheet's
`Participant NUMBER`. Canvas ("Download Submissions"): `lastfirst_USER_FILE_name`, with `LATE`
after the name where it was late.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

FILE = "file"
_MOODLE = re.compile(
    r"(?P<person>.+)_(?P<number>\d+)_assignsubmission_(?P<part>[a-z]+)(?:_(?P<own>.*))?"
)
_CANVAS = re.compile(r"(?P<person>[^_]+)(?:_LATE)?_(?P<number>\d+)_(?P<file>\d+)_(?P<own>.+)")


@dataclass(frozen=True)
class PlatformName:
    """Whose it is, as the platform says."""

    person: str
    number: str
    """Of the student on this platform."""
    part: str = FILE
    own: str = ""
    """What the student called the file, where that is told."""
    is_certain: bool = False
    """Nobody else gives such a name; else a student may have a file that is called so."""


def platform_name(name: str) -> PlatformName | None:
    """What the name tells; None where no platform made it."""
    if found := _MOODLE.fullmatch(name):
        own = found["own"] or ""
        return PlatformName(found["person"], found["number"], found["part"], own, True)
    if found := _CANVAS.fullmatch(name):
        return PlatformName(found["person"], found["number"], own=found["own"])
    return None


def beside_a_file(names: Iterable[str]) -> set[str]:
    """Those that are no file but a text beside the same student's file: a remark, no hand-in."""
    found = {name: told for name in names if (told := platform_name(name))}
    filed = {(told.person, told.number) for told in found.values() if told.part == FILE}
    return {
        name for name, told in found.items()
        if told.part != FILE and (told.person, told.number) in filed
    }  # fmt: skip
