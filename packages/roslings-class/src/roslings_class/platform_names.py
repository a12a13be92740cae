"""What learning platforms call a student's files when an instructor downloads them all.

Moodle (its assignment, "Download all submissions"): `Full Name_NUMBER_assignsubmission_PART`, a
folder, or the start of a file's name where the instructor chose no folders. PART is `file` or
`onlinetext`; older ones end with a line low. NUMBER is that of the grading worksheet's
`Participant NUMBER`. Canvas ("Download Submissions"): `lastfirst_USER_FILE_name`, with `LATE`
after the name where it was late.

What follows is the student's own: it may be called like another student's file. So only the start
counts. Both platforms take lines low out of a person's name (Moodle: mod/assign/locallib.php). So
nothing that a student writes, into a profile either, looks like the start.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

FILE = "file"
NOBODY = "Participant"
"""What Moodle calls everybody where it hides the names."""
MOODLE, CANVAS = "Moodle", "Canvas"
_FORMS = {
    MOODLE: re.compile(
        r"(?P<person>[^_]+)_(?P<number>[0-9]+)_assignsubmission_(?P<part>[a-z]+)(?:_(?P<own>.*))?",
        re.DOTALL,
    ),
    CANVAS: re.compile(
        r"(?P<person>[^_]+)(?P<late>_LATE)?_(?P<number>[0-9]+)_[0-9]+_(?P<own>.+)", re.DOTALL
    ),
}
"""No name has both forms."""


@dataclass(frozen=True)
class PlatformName:
    """Whose it is, as the platform says."""

    platform: str
    person: str
    number: str
    """Of the student on this platform."""
    part: str = FILE
    own: str = ""
    """What the student called the file, where that is told."""
    late: str = ""

    @property
    def is_late(self) -> bool:
        """Marked as late, by the due date that the platform has."""
        return bool(self.late)

    @property
    def is_certain(self) -> bool:
        """Nobody else gives such a name; else a student may have a file that is called so."""
        return self.platform == MOODLE


def platform_name(name: str) -> PlatformName | None:
    """What a name alone tells; None where no platform made it."""
    for platform, form in _FORMS.items():
        if found := form.fullmatch(name):
            told = {key: text or "" for key, text in found.groupdict().items()}
            return PlatformName(platform, **told)
    return None


def told_by_platform(names: Iterable[str]) -> dict[str, PlatformName]:
    """Each name of a download that its platform made, and what that says.

    One download is of one platform. A name of the other's form, or of none, is only a name: some
    person put it there.
    """
    told = {name: platform_name(name) for name in names}
    platform = _platform_of([each.platform if each else "" for each in told.values()])
    return {name: each for name, each in told.items() if each and each.platform == platform}


def _platform_of(platforms: list[str]) -> str:
    """The one that made most names. Canvas's form is not certain: it needs more than half."""
    counts = Counter(platforms)
    if counts[CANVAS] > counts[MOODLE] and 2 * counts[CANVAS] > len(platforms):
        return CANVAS
    return MOODLE


def beside_a_file(names: Iterable[str]) -> set[str]:
    """Those that are no file but a text beside the same student's file: a remark, no hand-in."""
    found = told_by_platform(names)
    filed = {(told.person, told.number) for told in found.values() if told.part == FILE}
    return {
        name
        for name, told in found.items()
        if told.part != FILE and (told.person, told.number) in filed
    }
