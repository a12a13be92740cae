"""The class list, and which submission is whose."""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from ros2_on_pip.typed_paths import from_here
from roslings.report.safe_text import harmless
from roslings_class.errors import BadTable, BatchError
from roslings_class.platform_names import PlatformName, told_by_platform
from roslings_class.tables import Row, read_table

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
SUBMISSION = "submission"
"""Its column names the submission that is this student's, by the instructor's word."""
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

    def logins_of_github(self) -> set[str]:
        """As GitHub compares them: `anna-berg` is somebody else than `annaberg`."""
        return {self.cells.get(column, "").strip().casefold() for column in GITHUB} - {""}

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
    """Each student to their submissions; none where nothing of theirs is sure."""
    unknown: list[str]
    """Submissions of nobody in the list."""
    unclear: dict[str, list[Student]]
    """Submissions of which nobody can say whose they are, with the students who may have sent them:
    one student, where somebody else may be called so."""

    def doubts(self, student: Student) -> list[str]:
        """Submissions that may be of this student."""
        return [name for name, owners in self.unclear.items() if student in owners]


def match(students: Sequence[Student], submissions: Iterable[str]) -> Matched:
    """Find out which submission is whose; never by a guess."""
    names = list(submissions)
    claims = _Matching(students, names).claims()
    found = Matched({student: [] for student in students}, [], {})
    for name, claim in claims.items():
        if not claim.owners:
            found.unknown.append(name)
        elif len(claim.owners) > 1 or claim.is_doubtful:
            found.unclear[name] = claim.owners
        else:
            found.of_student[claim.owners[0]].append(name)
    for student, own in found.of_student.items():
        for name in _of_others(own, claims):
            own.remove(name)
            found.unclear[name] = [student]
    return found


def _of_others(names: Sequence[str], claims: Mapping[str, _Claim]) -> list[str]:
    """Of one student's submissions those that somebody else may have sent.

    All of one sender are the student's own. Of several senders only one that is known counts.
    """
    surest = max((claims[name].surety for name in names), default=0)
    senders = {claims[name].sender for name in names if claims[name].surety == surest}
    if len(senders) > 1:
        return list(names)
    return [name for name in names if claims[name].sender not in senders]


IN_THE_LIST, BY_ACCOUNT, BY_NAME = 2, 1, 0
"""How sure it is: by the instructor's word, by what no two have, by what two may have."""


@dataclass(frozen=True)
class _Claim:
    """Whose a submission may be, and who says so."""

    owners: list[Student]
    sender: str = ""
    """One word for each account that sends; empty where no platform tells it."""
    surety: int = BY_NAME
    is_doubtful: bool = False
    """The class list knows its students by their accounts, and this account is not theirs."""


class _Matching:
    """The ways to find a student by a name, the surest first."""

    def __init__(self, students: Sequence[Student], names: Sequence[str]) -> None:
        self._students, self._names = students, names
        self._starts = shared_starts(names)
        self._told = told_by_platform(names)
        self._keys = {
            spelling: [(student, student.keys(spelling)) for student in students]
            for spelling in SPELLINGS
        }

    def claims(self) -> dict[str, _Claim]:
        """Each submission, and who may have handed it in."""
        found = {name: self._claim(name) for name in self._names}
        known = {found[name].sender for name in found if found[name].surety == BY_ACCOUNT}
        has_logins = any(sender.startswith(CLONE) for sender in known)
        has_numbers = any(not sender.startswith(CLONE) for sender in known)
        return {name: self._doubted(each, has_numbers, has_logins) for name, each in found.items()}

    def _doubted(self, claim: _Claim, has_numbers: bool, has_logins: bool) -> _Claim:
        """A name is not enough where the list has another account of that student."""
        if claim.surety != BY_NAME or not claim.sender:
            return claim
        if claim.sender.startswith(CLONE):
            is_doubtful = has_logins and all(each.logins_of_github() for each in claim.owners)
        else:
            is_doubtful = has_numbers and all(each.numbers() for each in claim.owners)
        return replace(claim, is_doubtful=claim.is_doubtful or is_doubtful)

    def _claim(self, name: str) -> _Claim:
        listed = [each for each in self._students if each.cells.get(SUBMISSION) == name]
        if listed:
            return _Claim(listed, f"listed {name}", IN_THE_LIST)
        if told := self._told.get(name):
            return self._of_platform(told)
        return self._of_clone(name) or _Claim(self._by_name(name))

    def _of_platform(self, told: PlatformName) -> _Claim:
        """As the platform says; what the student called the file says nothing.

        The number decides where two have one name. Where name and number are of two students, one
        of them may have taken the other's name: a person decides.
        """
        sender = f"{told.platform} {told.number}"
        numbered = [student for student in self._students if told.number in student.numbers()]
        named = self._by_person(told.person)
        if both := [each for each in named if each in numbered]:
            return _Claim(both, sender, BY_ACCOUNT)
        if named and numbered:
            return _Claim([*named, *numbered], sender, is_doubtful=True)
        if numbered:
            return _Claim(numbered, sender, BY_ACCOUNT)
        return _Claim(named or self._named_by({told.number}, squashed), sender)

    def _by_person(self, person: str) -> list[Student]:
        """By the name in the platform's own part, and its words."""
        of_group = {rest for _, rest in _cuts(person)}  # `Group A-Anna Berg`
        ways = ({person}, of_group, _parts(person))
        return self._first(lambda spelling: (self._named_by(way, spelling) for way in ways))

    def _of_clone(self, name: str) -> _Claim | None:
        """What stands after the start that most names share: `lab-topics-` of a clone."""
        tails = [tail for start, tail in _cuts(name) if start in self._starts]
        sender = f"{CLONE}{name.casefold()}"
        for tail in tails:
            if own := [each for each in self._students
                       if tail.casefold() in each.logins_of_github()]:  # fmt: skip
                return _Claim(own, sender, BY_ACCOUNT)
        if self._by_name(name):
            return None
        named = self._first(lambda spelling: (self._named_by({tail}, spelling) for tail in tails))
        return _Claim(named, sender) if named else None

    def _by_name(self, name: str) -> list[Student]:
        ways = ({name}, _parts(name))
        return self._first(lambda spelling: (self._named_by(way, spelling) for way in ways))

    def _first(self, ways: Callable[[Spelling], Iterable[list[Student]]]) -> list[Student]:
        """Whom the first way finds, in the first spelling that finds anybody."""
        found = (owners for spelling in SPELLINGS for owners in ways(spelling))
        return next((owners for owners in found if owners), [])

    def _named_by(self, parts: set[str], spelling: Spelling) -> list[Student]:
        spelled = {spelling(part) for part in parts}
        return [student for student, own in self._keys[spelling] if own & spelled]


CLONE = "clone "
"""The sender of a repository: GitHub gives each account one of its own."""


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
