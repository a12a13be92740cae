"""All labs of a class together: who has not begun, who stopped where, and since when."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

from ros2_on_pip.typed_paths import from_here
from roslings.course import all_labs
from roslings_class.errors import BatchError, NoGradebook
from roslings_class.gradebook import gradebook, lab_of
from roslings_class.grades import UNCLEAR, StudentGrade, class_of
from roslings_class.handing_out import settings_of
from roslings_class.roster import IDENTIFIER, Student, read_roster, squashed

MISSING = "missing"
NOT_BEGUN = "has not begun"
HANDED_IN, GRADED = "handed in", "first graded"


class LabTwice(BatchError):
    """Two gradebooks are of one lab."""

    def __init__(self, lab: str, one: Path, other: Path) -> None:
        problem = f"{from_here(one)} and {from_here(other)} are both of the lab {lab!r}."
        super().__init__(problem, "Give one of them.")


class NoClassList(BatchError):
    """Nobody says who is in the class, so nobody can be missing."""

    def __init__(self) -> None:
        super().__init__(
            "No class list was given, and none of these gradebooks was made with one.",
            "Give it: --roster class.csv",
        )


@dataclass(frozen=True)
class LabGrades:
    """One lab's gradebook."""

    lab: str
    folder: Path
    grades: list[StudentGrade]
    """With a class list one for each student in it, and those of nobody."""
    students: list[Student]
    graded: dict[str, datetime]
    """Submission to when its content was graded first."""


@dataclass(frozen=True)
class Since:
    """When somebody was seen last."""

    at: datetime
    what: str
    """HANDED_IN, or GRADED where only that is known."""


@dataclass
class StudentStanding:
    """Where one student stands."""

    student: Student
    grades: dict[str, StudentGrade] = field(default_factory=dict)
    """Lab to what came of it, where anything was handed in."""
    since: Since | None = None
    """When the last of these labs was handed in."""

    def state(self, labs: Sequence[str]) -> str:
        """Not begun, stopped after a lab, or which labs were left out; empty where all is there."""
        done = [lab for lab in labs if lab in self.grades]
        if not done:
            return NOT_BEGUN
        if done[-1] != labs[-1]:
            return f"stopped after {done[-1]}"
        left_out = [lab for lab in labs if lab not in self.grades]
        return f"left out {', '.join(left_out)}" if left_out else ""


@dataclass(frozen=True)
class Overview:
    """All that is known of a class."""

    books: list[LabGrades]
    standings: list[StudentStanding]
    not_in_list: list[str]
    """Students of a lab's own list who are not in the list that was given."""

    @property
    def labs(self) -> list[str]:
        """In the order of the course."""
        return [book.lab for book in self.books]

    def in_state(self, state: str) -> list[StudentStanding]:
        """Those who stand so."""
        return [each for each in self.standings if each.state(self.labs) == state]


def overview(folders: Sequence[Path], roster: Path | None) -> Overview:
    """Join gradebooks; the class is in `roster`, else in all the lists that they were made with.

    Raises BatchError.
    """
    given = read_roster(roster) if roster else []
    books = [*_in_order(folders, given)]
    people = _People()
    people.join(given)
    not_in_list: list[str] = []
    for book in books:
        of_list = people.join(book.students, may_add=not given)
        not_in_list += [who.name for who in book.students if who not in of_list]
        for grade in book.grades:
            if grade.student in of_list and grade.outcome != MISSING:
                _put(of_list[grade.student], grade, book)
    if not people.standings:
        raise NoClassList
    return Overview(books, people.standings, sorted({*not_in_list}))


def _put(standing: StudentStanding, grade: StudentGrade, book: LabGrades) -> None:
    standing.grades[book.lab] = grade
    standing.since = _since(grade, book) or standing.since


def _since(grade: StudentGrade, book: LabGrades) -> Since | None:
    if at := grade.handed_in.at:
        return Since(at, HANDED_IN)
    graded = book.graded.get(grade.submission)
    return Since(graded, GRADED) if graded else None


def _in_order(folders: Sequence[Path], given: Sequence[Student]) -> Iterator[LabGrades]:
    found: dict[str, Path] = {}
    for folder in folders:
        if (lab := lab_of(folder)) is None:
            raise NoGradebook(folder)
        if lab in found:
            raise LabTwice(lab, found[lab], folder)
        found[lab] = folder
    order = [lab.name for lab in all_labs()]
    names = sorted(found, key=lambda lab: (order.index(lab) if lab in order else len(order), lab))
    return (_read(lab, found[lab], given) for lab in names)


def _read(lab: str, folder: Path, given: Sequence[Student]) -> LabGrades:
    with gradebook(folder, lab) as book:
        settings = settings_of(book)
        students = read_roster(settings.roster) if settings.roster else list(given)
        found = class_of(book, settings.known_times(), students, settings.rule)
        return LabGrades(lab, folder, found.grades, students, book.first_graded())


# --- who is who --------------------------------------------------------------------------------


class _People:
    """Each student once, though each lab has a list of its own.

    Moodle numbers the participants of each assignment anew. So a person is known by the address, by
    the number that the school gave, or by the name. But a person is never known where two of these
    contradict.
    """

    def __init__(self) -> None:
        self.standings: list[StudentStanding] = []
        self._known: defaultdict[tuple[str, str], list[StudentStanding]] = defaultdict(list)

    def join(
        self, students: Iterable[Student], may_add: bool = True
    ) -> dict[Student, StudentStanding]:
        """Who of these is whom; two of one list are two persons, but for two equal lines."""
        of_list: dict[Student, StudentStanding] = {}
        for student in dict.fromkeys(students):
            person = self._find(student, [*of_list.values()])
            if person is None and may_add:
                person = self._add(student)
            if person:
                of_list[student] = person
        return of_list

    def _find(self, student: Student, taken: Sequence[StudentStanding]) -> StudentStanding | None:
        for key in _keys(student).items():
            same = [
                each
                for each in self._known[key]
                if not any(each is one for one in taken) and not _differ(each.student, student)
            ]
            if len(same) == 1:
                return same[0]
        return None

    def _add(self, student: Student) -> StudentStanding:
        standing = StudentStanding(student)
        self.standings.append(standing)
        for key in _keys(student).items():
            self._known[key].append(standing)
        return standing


def _keys(student: Student) -> dict[str, str]:
    """The surest first."""
    is_of_moodle = student.id == student.cells.get(IDENTIFIER, "").strip()
    keys = {
        "email": student.email.strip().casefold(),
        "id": "" if is_of_moodle else squashed(student.id),
        "name": squashed(student.name),
    }
    return {name: text for name, text in keys.items() if text}


def _differ(one: Student, other: Student) -> bool:
    """Both have an address, or both have a number, and it is not the same."""
    ours, theirs = _keys(one), _keys(other)
    return any(ours[key] != theirs[key] for key in ("email", "id") if key in ours and key in theirs)


def score_in(grade: StudentGrade | None) -> str:
    """The score; else the outcome, and nothing where nothing was handed in."""
    if grade is None:
        return ""
    return grade.outcome if grade.final is None or grade.outcome == UNCLEAR else f"{grade.final:g}"
