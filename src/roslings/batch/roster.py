"""The class list, and which submission is whose."""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from roslings.batch.errors import BadTable, BatchError
from roslings.batch.platform_names import platform_name
from roslings.batch.tables import Row, read_table
from roslings.report.safe_text import harmless
from roslings.workspace.errors import from_here

NAMES = ("name", "student", "full name", "student name")
FIRST, LAST = ("first name", "firstname"), ("last name", "lastname", "surname")
IDS = ("id", "student id", "sis user id", "id number", "number")
EMAILS = ("email", "email address", "e-mail")
LOGINS = ("sis login id", "login", "username", "user")
GITHUB = ("github_username", "github username", "github name", "github login", "github")
IDENTIFIER = "identifier"
"""Moodle's `Participant 123`, or what GitHub Classroom's teacher calls a student by."""
CANVAS_ALONE = {"sis user id", "sis login id"}
"""Columns that only its class lists have: there `id` is the number in a file's name."""
SHORTEST_KEY = 3
HOW = (
    "A submission finds its student by its name: it is, or has in it between low lines or spaces,\n"
    "the id, the address or its part before the @, the login, or the whole name. A folder like\n"
    "`lab-topics-annaberg` finds its student by the login, or by a column `github_username`.\n"
    "Bring the class list up to date, or give a CSV file with the columns student, path."
)
_NO_WORD = re.compile(r"[\W_]+")
_LAST_NUMBER = re.compile(r"\s(\d+)$")
_BETWEEN = re.compile(r"[_\s(),]+")
_WRITTEN_OUT = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "å": "aa", "ø": "oe", "æ": "ae"})
Spelling = Callable[[str], str]


def squashed(text: str) -> str:
    """Letters and digits alone, small; however the file system writes an accent."""
    return _NO_WORD.sub("", unicodedata.normalize("NFKC", text)).casefold()


def without_accents(text: str) -> str:
    """The same in plain letters: `Zoë` is `zoe`."""
    apart = unicodedata.normalize("NFKD", squashed(text))
    return "".join(char for char in apart if not unicodedata.combining(char))


def written_out(text: str) -> str:
    """The same as German and Scandinavian addresses have it: `Müller` is `mueller`."""
    return without_accents(squashed(text).translate(_WRITTEN_OUT))


SPELLINGS: tuple[Spelling, ...] = (squashed, without_accents, written_out)
"""The first by which anybody is found counts."""


@dataclass(frozen=True)
class Student:
    """One line of the class list."""

    name: str
    id: str = ""
    email: str = ""
    login: str = ""
    cells: dict[str, str] = field(default_factory=dict, compare=False)
    """All that the list says, column in small letters to text."""

    def keys(self, spelling: Spelling = squashed) -> set[str]:
        """What a submission of theirs may be called."""
        keys = {spelling(text) for text in self._told()}
        return {key for key in keys if len(key) >= SHORTEST_KEY}

    def _told(self) -> Iterator[str]:
        words = self.name.replace(",", " ").split()
        yield from (self.name, "".join(words[-1:] + words[:-1]), "".join(words[1:] + words[:1]))
        identifier = self.cells.get(IDENTIFIER, "")
        for address in (self.email, identifier):
            yield from (address, address.partition("@")[0])
        yield from (self.id, self.login, *self.numbers())
        yield from (self.cells.get(column, "") for column in GITHUB)

    def numbers(self) -> set[str]:
        """What a platform numbers the student with, however short; not what others do."""
        of_moodle = _LAST_NUMBER.findall(self.cells.get(IDENTIFIER, ""))
        of_canvas = (
            [self.cells["id"]] if "id" in self.cells and CANVAS_ALONE & set(self.cells) else []
        )
        return {number.strip() for number in (*of_moodle, *of_canvas)} - {""}

    def is_called(self, who: str) -> bool:
        """Whether a person may mean this student by that."""
        return squashed(who) in {squashed(self.name), *self.keys()}


def read_roster(path: Path) -> list[Student]:
    """The students of a class list. Raises BadTable."""
    students = [_student(row) for row in read_table(path) if not _is_about_points(row)]
    if not students:
        raise BadTable(path, 2, "there is no student.", "Each line below the first is one student.")
    return students


def _is_about_points(row: Row) -> bool:
    """Canvas exports a line of points before the first student."""
    return row.first(NAMES).lower() == "points possible"


def insist_on_owners(path: Path, submissions: Sequence[str]) -> None:
    """Raises NobodyInTheList where no submission is of anybody in the list, and BadTable."""
    students = read_roster(path)
    found = match(students, submissions)
    if not found.unclear and not any(found.of_student.values()):
        raise NobodyInTheList(path, students, submissions)


class NobodyInTheList(BatchError):
    """No submission is of anybody in the class list."""

    def __init__(self, path: Path, students: Sequence[Student], names: Sequence[str]) -> None:
        handed_in, listed = (
            ", ".join(map(repr, some[:3])) for some in (names, [each.name for each in students])
        )
        super().__init__(
            f"{from_here(path)}: no submission is of anybody in this class list.\n"
            f"Submissions are called, for example: {harmless(handed_in)}\n"
            f"Students are called, for example: {harmless(listed)}",
            HOW,
        )


def _student(row: Row) -> Student:
    name = row.first(NAMES) or f"{row.first(FIRST)} {row.first(LAST)}".strip()
    return Student(
        name or row.needed((*NAMES, *IDS, *EMAILS, IDENTIFIER, *GITHUB)),
        row.first((*IDS, IDENTIFIER)), row.first(EMAILS), row.first(LOGINS), row.cells,
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
    """Find out which submission is whose; never by a guess."""
    found = Matched({student: [] for student in students}, [], {})
    names = list(submissions)
    matching = _Matching(students, shared_starts(names))
    for name in names:
        owners = matching.owners(name)
        if len(owners) == 1:
            found.of_student[owners[0]].append(name)
        elif owners:
            found.unclear[name] = [owner.name for owner in owners]
        else:
            found.unknown.append(name)
    return found


class _Matching:
    """The ways to find a student by a name, the surest first."""

    def __init__(self, students: Sequence[Student], starts: set[str]) -> None:
        self._students, self._starts = students, starts
        self._keys = {
            spelling: {student: student.keys(spelling) for student in students}
            for spelling in SPELLINGS
        }

    def owners(self, name: str) -> list[Student]:
        """Who may have handed in what is called so."""
        ways = (self._of_platform, self._by_parts)
        found = (way(name, spelling) for spelling in SPELLINGS for way in ways)
        return next((owners for owners in found if owners), [])

    def _of_platform(self, name: str, spelling: Spelling) -> list[Student]:
        """As the platform says: the name, and the number where two have one name."""
        told = platform_name(name)
        if told is None:
            return []
        of_group = {rest for _, rest in _cuts(told.person)}  # `Group A-Anna Berg`
        named = self._named_by({told.person}, spelling) or self._named_by(of_group, spelling)
        numbered = [student for student in self._students if told.number in student.numbers()]
        return [each for each in named if each in numbered] or named or numbered

    def _by_parts(self, name: str, spelling: Spelling) -> list[Student]:
        return (
            self._named_by({name}, spelling)
            or self._named_by(_parts(name), spelling)
            or self._by_tails(name, spelling)
        )

    def _by_tails(self, name: str, spelling: Spelling) -> list[Student]:
        """What stands after the start that most names share: `lab-topics-` of a clone."""
        tails = (tail for start, tail in _cuts(name) if start in self._starts)
        found = (self._named_by({tail}, spelling) for tail in tails)
        return next((owners for owners in found if owners), [])

    def _named_by(self, parts: set[str], spelling: Spelling) -> list[Student]:
        spelled = {spelling(part) for part in parts}
        return [student for student, own in self._keys[spelling].items() if own & spelled]


def _parts(name: str) -> set[str]:
    """Between lines low and spaces: `Anna B_123_assignsubmission_file_` and `bergannalate_123`."""
    return {*name.split("_"), *_BETWEEN.split(name)}


def _cuts(name: str) -> Iterator[tuple[str, str]]:
    """The name before and after each `-`, the longest rest first."""
    pieces = name.split("-")
    for at in range(1, len(pieces)):
        yield "-".join(pieces[:at]), "-".join(pieces[at:])


def shared_starts(names: Sequence[str]) -> set[str]:
    """What more than half of the names have before a `-`: it tells of the lab, not of a student."""
    starts = Counter(start for name in names for start, _ in _cuts(name))
    return {start for start, count in starts.items() if 2 * count > len(names)}
