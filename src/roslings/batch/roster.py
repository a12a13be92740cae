"""The class list, and which submission is whose."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from roslings.batch.tables import Row, read_table
from roslings.batch.trouble import BadTable

NAMES = ("name", "student", "full name", "student name")
FIRST, LAST = ("first name", "firstname"), ("last name", "lastname", "surname")
IDS = ("id", "student id", "sis user id", "id number", "number")
EMAILS = ("email", "email address", "e-mail")
LOGINS = ("sis login id", "login", "username", "user")
OTHER_KEYS = ("identifier",)
"""Moodle's `Participant 123`: the number stands in the name of the file."""
SHORTEST_KEY = 3
_NO_WORD = re.compile(r"[\W_]+")
_BETWEEN = re.compile(r"[_\s(),]+")


@dataclass(frozen=True)
class Student:
    """One line of the class list."""

    name: str
    id: str = ""
    email: str = ""
    login: str = ""
    cells: dict[str, str] = field(default_factory=dict, compare=False)
    """All that the list says, column in small letters to text."""

    def keys(self) -> set[str]:
        """What a submission of theirs may be called."""
        words = self.name.replace(",", " ").split()
        turned = ["".join(words[-1:] + words[:-1]), "".join(words[1:] + words[:1])]
        more = [re.sub(r"\D", "", self.cells.get(column, "")) for column in OTHER_KEYS]
        local = self.email.partition("@")[0]
        given = [self.id, self.email, local, self.login, self.name, *turned, *more]
        return {key for text in given if len(key := squashed(text)) >= SHORTEST_KEY}


def squashed(text: str) -> str:
    """Letters and digits alone, small."""
    return _NO_WORD.sub("", text).casefold()


def read_roster(path: Path) -> list[Student]:
    """The students of a class list. Raises BadTable."""
    students = [_student(row) for row in read_table(path) if not _is_about_points(row)]
    if not students:
        raise BadTable(path, 2, "there is no student.", "Each line below the first is one student.")
    return students


def _is_about_points(row: Row) -> bool:
    """Canvas exports a line of points before the first student."""
    return row.first(NAMES).lower() == "points possible"


def _student(row: Row) -> Student:
    name = row.first(NAMES) or f"{row.first(FIRST)} {row.first(LAST)}".strip()
    return Student(
        name or row.needed((*NAMES, *IDS, *EMAILS)),
        row.first(IDS), row.first(EMAILS), row.first(LOGINS), row.cells,
    )  # fmt: skip


@dataclass(frozen=True)
class Matched:
    """The class list joined to the submissions."""

    of_student: dict[Student, list[str]]
    """Each student to their submissions; none where nothing was handed in."""
    unknown: list[str]
    """Submissions of nobody in the list."""
    unclear: dict[str, list[str]]
    """Submissions that may be of several students, with their names."""

    @property
    def missing(self) -> list[Student]:
        """Who handed in nothing."""
        return [student for student, names in self.of_student.items() if not names]


def match(students: Sequence[Student], submissions: Iterable[str]) -> Matched:
    """Find out which submission is whose: the whole name first, then the parts of it."""
    found = Matched({student: [] for student in students}, [], {})
    keys = {student: student.keys() for student in students}
    for name in submissions:
        owners = _owners(keys, {squashed(name)}) or _owners(keys, _parts(name))
        if len(owners) == 1:
            found.of_student[owners[0]].append(name)
        elif owners:
            found.unclear[name] = [owner.name for owner in owners]
        else:
            found.unknown.append(name)
    return found


def _owners(keys: dict[Student, set[str]], parts: set[str]) -> list[Student]:
    return [student for student, own in keys.items() if own & parts]


def _parts(name: str) -> set[str]:
    """Between lines low and spaces: `Anna B_123_assignsubmission_file_` and `bergannalate_123`."""
    return {squashed(part) for part in (*name.split("_"), *_BETWEEN.split(name))}
