"""The class list, and which submission is whose."""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

from ros2_on_pip.safe_text import harmless
from ros2_on_pip.typed_paths import from_here
from roslings_class.errors import BadTable, BatchError
from roslings_class.headings import CHANGED, other_language
from roslings_class.platform_names import CANVAS, MOODLE, PlatformName, told_by_platform
from roslings_class.tables import TableRow, read_table
from roslings_class.teams import Teams, as_in_the_gradebook

NAMES = ("name", "student", "full name", "student name")
FIRST, LAST = ("first name", "firstname"), ("last name", "lastname", "surname")
IDS = ("id", "student id", "sis user id", "id number", "number")
EMAILS = ("email", "email address", "e-mail")
LOGINS = ("sis login id", "login", "username", "user")
GITHUB = ("github_username", "github username", "github name", "github login", "github")
IDENTIFIER = "identifier"
"""Moodle's `Participant 123`, or what GitHub Classroom's teacher calls a student by."""
ROSTER_IDENTIFIER, REPOSITORY = "roster_identifier", "student_repository_name"
"""Columns of GitHub Classroom's grades: what the teacher calls the student by, and the clone."""
CANVAS_ALONE = {"sis user id", "sis login id"}
"""Columns that only its class lists have: there `id` is the number in a file's name."""
SUBMISSION = "submission"
"""Its column names the submission that is this student's, by the instructor's word."""
SHORTEST_KEY = 3
"""In letters; a sign of Chinese, Japanese or Korean counts as two."""
WHO = (*IDS, *EMAILS, *LOGINS, *GITHUB, IDENTIFIER, ROSTER_IDENTIFIER)
"""Columns that name a student, beside the name."""
HOW = (
    "A submission finds its student by its name: it is, or has in it between low lines or spaces,\n"
    "the id, the address or its part before the @, the login, or the whole name. A folder like\n"
    "`lab-topics-annaberg` finds its student by the login, or by a column `github_username`.\n"
    "Where teams hand in, the list names them: a column `team`, or Moodle's worksheet as it is.\n"
    "Bring the class list up to date, or give a CSV file with the columns student, path."
)
_NO_WORD = re.compile(r"[\W_]+")
_ABOUT_POSTING = re.compile(r"(Muted|Manual Posting.*)", re.IGNORECASE)
_LAST_NUMBER = re.compile(r"\s(\d+)$")
_NUMBER_AT_END = re.compile(r"(\d+)$")
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
    """All that the list says, column in English and small letters to text."""

    def keys(self, spelling: Spelling = squashed) -> set[str]:
        """What a submission of theirs may be called."""
        keys = {spelling(text) for text in self._told()}
        return {key for key in keys if _letters(key) >= SHORTEST_KEY}

    def _told(self) -> Iterator[str]:
        words = self.name.replace(",", " ").split()
        yield from (self.name, "".join(words[-1:] + words[:-1]), "".join(words[1:] + words[:1]))
        identifiers = (self.cells.get(each, "") for each in (IDENTIFIER, ROSTER_IDENTIFIER))
        for address in (self.email, *identifiers):
            yield from (address, address.partition("@")[0])
        yield from (self.id, self.login, *self.numbers())
        yield from (self.cells.get(column, "") for column in GITHUB)

    def numbers(self) -> set[str]:
        """What a platform numbers the student with, however short; not what others do."""
        form = _NUMBER_AT_END if CHANGED in self.cells else _LAST_NUMBER
        of_moodle = form.findall(self.cells.get(IDENTIFIER, "").strip())
        of_canvas = (
            [self.cells["id"]] if "id" in self.cells and CANVAS_ALONE & set(self.cells) else []
        )
        return {number.strip() for number in (*of_moodle, *of_canvas)} - {""}

    def logins_of_github(self) -> set[str]:
        """As GitHub compares them: `anna-berg` is somebody else than `annaberg`."""
        return {self.cells.get(column, "").strip().casefold() for column in GITHUB} - {""}

    def listed(self) -> set[str]:
        """The submissions that the class list itself says are this student's."""
        return {self.cells.get(SUBMISSION, ""), repository_of(self.cells)} - {""}

    def named(self) -> set[str]:
        """All by which a list may name the student, however short, squashed."""
        cells = (self.cells.get(column, "") for column in WHO)
        return {squashed(text) for text in (*self._told(), *cells)} - {""}

    def is_called(self, who: str) -> bool:
        """Whether a person may mean this student by that."""
        return squashed(who) in {squashed(self.name), *self.keys()}


def read_roster(path: Path) -> list[Student]:
    """The students of a class list. Raises BadTable."""
    rows = [
        replace(row, cells=as_in_the_gradebook(row.cells))
        for row in read_table(path)
        if not _is_about_columns(row)
    ]
    _insist_on_columns(path, rows)
    students = [_student(row) for row in rows]
    if not students:
        raise BadTable(path, 2, "there is no student.", "Each line below the first is one student.")
    return students


def _is_about_columns(row: TableRow) -> bool:
    """Canvas exports up to two lines about its columns before the first student."""
    texts = [text.strip() for text in row.cells.values() if text.strip()]
    is_of_points = texts[0].lower() == "points possible"
    return is_of_points or all(map(_ABOUT_POSTING.fullmatch, texts))


def _insist_on_columns(path: Path, rows: Sequence[TableRow]) -> None:
    if rows and not {*NAMES, *FIRST, *LAST, *WHO} & rows[0].cells.keys():
        heads = ", ".join(map(repr, rows[0].cells))
        problem = f"no column is known that says who a student is: {harmless(heads)}."
        raise BadTable(path, 1, problem, f"Call one name, id or email.\n{other_language()}")


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


def _student(row: TableRow) -> Student:
    name = _name_in(row)
    return Student(
        name or row.needed((*NAMES, *IDS, *EMAILS, IDENTIFIER, ROSTER_IDENTIFIER, *GITHUB)),
        row.first((*IDS, IDENTIFIER)),
        row.first(EMAILS),
        row.first(LOGINS),
        row.cells,
    )


def told_of(row: TableRow) -> tuple[str, ...]:
    """All by which a line of any list names its student."""
    own = _student(row) if row.first((*NAMES, *FIRST, *LAST, *WHO)) else None
    told = (own.name, *(row.cells.get(column, "").strip() for column in WHO)) if own else ()
    return tuple(dict.fromkeys(filter(None, told)))


def repository_of(cells: Mapping[str, str]) -> str:
    """The clone that GitHub Classroom's grades name, without the organisation before it."""
    return cells.get(REPOSITORY, "").strip().rpartition("/")[2]


def _name_in(row: TableRow) -> str:
    """The whole name; of `Nom, Prénom` and `Nome, Sobrenome` each column holds a part of it."""
    whole, first, last = row.first(NAMES), row.first(FIRST), row.first(LAST)
    part = first or last
    if whole and (bool(first) == bool(last) or {*part.split()} < {*whole.split()}):
        return whole
    return _together(first or whole, last or whole)


def _together(first: str, last: str) -> str:
    """As it is written: `王小明` has the family name first, and no space."""
    is_wide = first and last and all(map(_is_wide, first + last))
    return f"{last}{first}" if is_wide else f"{first} {last}".strip()


def _letters(key: str) -> int:
    return sum(1 + _is_wide(sign) for sign in key)


def _is_wide(sign: str) -> bool:
    return unicodedata.east_asian_width(sign) in "WF"


@dataclass(frozen=True)
class RosterMatch:
    """The class list joined to the submissions."""

    of_student: dict[Student, list[str]]
    """Each student to their submissions; none where nothing of theirs is sure."""
    unknown: list[str]
    """Submissions of nobody in the list."""
    unclear: dict[str, list[Student]]
    """Submissions of which nobody can say whose they are, with the students who may have sent them.
    It is one student, where somebody else may be called so."""
    teams: dict[str, list[Student]] = field(default_factory=dict)
    """Submissions of several students, who all have them."""

    def doubts(self, student: Student) -> list[str]:
        """Submissions that may be of this student."""
        return [name for name, owners in self.unclear.items() if student in owners]


def match(students: Sequence[Student], submissions: Iterable[str]) -> RosterMatch:
    """Find out which submission is whose; never by a guess."""
    names = list(submissions)
    claims = _Matching(students, names).claims()
    found = RosterMatch({student: [] for student in students}, [], {})
    for name, claim in claims.items():
        if not claim.owners:
            found.unknown.append(name)
        elif claim.is_doubtful or (len(claim.owners) > 1 and not claim.is_teams):
            found.unclear[name] = claim.owners
        elif claim.is_teams:
            found.teams[name] = claim.owners
            for owner in claim.owners:
                found.of_student[owner].append(name)
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
    is_teams: bool = False
    """All of the owners have it."""


class _Matching:
    """The ways to find a student by a name, the surest first."""

    def __init__(self, students: Sequence[Student], names: Sequence[str]) -> None:
        self._students, self._names = students, names
        self._starts = shared_starts(names)
        self._told = told_by_platform(names)
        self._teams = Teams(students, squashed)
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
        if claim.surety != BY_NAME or not claim.sender or claim.is_teams:
            return claim
        if claim.sender.startswith(CLONE):
            is_doubtful = has_logins and all(each.logins_of_github() for each in claim.owners)
        else:
            is_doubtful = has_numbers and all(each.numbers() for each in claim.owners)
        return replace(claim, is_doubtful=claim.is_doubtful or is_doubtful)

    def _claim(self, name: str) -> _Claim:
        listed = [each for each in self._students if name in each.listed()]
        if listed:
            return _Claim(listed, f"listed {name}", IN_THE_LIST, is_teams=len(listed) > 1)
        if told := self._told.get(name):
            return self._of_team(told) or self._of_platform(told)
        if claim := self._of_clone(name):
            return claim
        own, teams = self._by_name(name), self._teams.of_folder(name)
        return self._as_team(teams, f"team {name}", BY_NAME) if teams and not own else _Claim(own)

    def _as_team(self, teams: Sequence[str], sender: str, surety: int) -> _Claim:
        """Of the one team that is meant; where several may be, a person decides."""
        members = self._teams.members(teams)
        return _Claim(members, sender, surety, is_doubtful=len(teams) > 1, is_teams=True)

    def _of_team(self, told: PlatformName) -> _Claim | None:
        """Where teams hand in, the name is the team's; Moodle's number is that of the group.

        Where somebody hands in alone, a profile may be called like a team: a person decides.
        """
        teams = self._teams.named(told.person)
        if not teams:
            return None
        numbered = self._numbered(told) if told.platform == CANVAS else []
        sure = [
            each for each in teams if any(one in numbered for one in self._teams.members([each]))
        ]
        claim = self._as_team(sure or teams, f"{told.platform} {told.number}", BY_ACCOUNT)
        is_anothers = bool(numbered) and not any(each in claim.owners for each in numbered)
        return replace(claim, is_doubtful=claim.is_doubtful or is_anothers or self._is_of_persons)

    @cached_property
    def _is_of_persons(self) -> bool:
        """Whether the download has somebody's own hand-in in it."""
        persons = {told.person for told in self._told.values()}
        return any(self._by_person(each) for each in persons if not self._teams.named(each))

    @cached_property
    def _has_persons_clones(self) -> bool:
        """The same of clones: a repository that is called by one student's account."""
        logins = Counter(login for each in self._students for login in each.logins_of_github())
        alone = {login for login, count in logins.items() if count == 1}
        tails = (t for name in self._names for start, t in _cuts(name) if start in self._starts)
        return any(tail.casefold() in alone for tail in tails)

    @cached_property
    def _has_groups_numbers(self) -> bool:
        """Whether Moodle's numbers are those of groups, of which the class list knows nothing.

        Nobody is called as the folders are, and most numbers are nobody's.
        """
        told = [each for each in self._told.values() if each.platform == MOODLE]
        numbered = sum(bool(self._numbered(each)) for each in told)
        return (
            len({each.person for each in told}) > 1
            and 2 * numbered < len(told)
            and not any(self._by_person(each.person) for each in told)
        )

    def _numbered(self, told: PlatformName) -> list[Student]:
        return [student for student in self._students if told.number in student.numbers()]

    def _of_platform(self, told: PlatformName) -> _Claim:
        """As the platform says; what the student called the file says nothing.

        The number decides where two have one name. Where name and number are of two students, one
        of them may have taken the other's name: a person decides.
        """
        sender = f"{told.platform} {told.number}"
        numbered = self._numbered(told)
        named = self._by_person(told.person)
        if both := [each for each in named if each in numbered]:
            return _Claim(both, sender, BY_ACCOUNT)
        if named and numbered:
            return _Claim([*named, *numbered], sender, is_doubtful=True)
        if numbered:
            return _Claim(numbered, sender, BY_ACCOUNT, is_doubtful=self._has_groups_numbers)
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
            if own := [
                each for each in self._students if tail.casefold() in each.logins_of_github()
            ]:
                return _Claim(own, sender, BY_ACCOUNT, is_teams=len(own) > 1)
            if teams := self._teams.named(tail):
                claim = self._as_team(teams, sender, BY_ACCOUNT)
                return replace(claim, is_doubtful=claim.is_doubtful or self._has_persons_clones)
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
