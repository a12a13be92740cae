"""Each student's own card of a lab: whose it is, and a course by it for each grading.

Whose card a hand-in is judged by, the class list decides, never the hand-in.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from roslings.course import Lab
from roslings.course.contract import Plain, as_typed
from roslings.course.variants import LabVariant, NoVariants, Variants, variants_of
from roslings_class.csv_files import write_lines
from roslings_class.errors import BatchError
from roslings_class.result import GradingResult
from roslings_class.roster import GITHUB, IDENTIFIER, Student, match
from roslings_class.teams import team_of

NUMBERS = ("sis user id", "student id", "id number", "number")
"""What a student is numbered with, and knows; Canvas's own `id` is another number."""
FILE = "cards.csv"
Words = Mapping[str, Plain]


class NoList(BatchError):
    """Nobody can tell whose card a hand-in is to be judged by."""

    def __init__(self) -> None:
        super().__init__(
            "Each student has a card of their own, and the class list tells whose is whose.",
            "Give it: --roster FILE",
        )


class OneMachine(BatchError):
    """Other machines have the course as it is."""

    def __init__(self) -> None:
        super().__init__(
            "Cards of students' own are graded on this machine only.", "Leave out --dask."
        )


@dataclass(frozen=True)
class Courses:
    """The courses of some cards; each is made once, when it is asked for first."""

    lab: Lab
    variants: Variants | None
    """None: everybody has the same card."""
    folder: Path

    def words_of(self, whose: str) -> dict[str, Plain]:
        """What is a student's own in the card."""
        return self.variants.chosen(self.lab.name, whose) if self.variants else {}

    def course(self, words: Words) -> Path:
        """Where the lab's files say these words. Raises NoVariants."""
        if self.variants is None:
            raise NoVariants(self.lab)
        chosen = LabVariant(self.lab, self.variants, words)
        place = self.folder / f"{self.lab.name}-{chosen.digest()}"
        return place if place.is_dir() else chosen.make(place)

    def lab_of(self, result: GradingResult) -> Lab:
        """The lab as it was graded; everybody's where the result has no words of its own."""
        if not result.words:
            return self.lab
        course = self.course(result.words)
        grader = course / "graders" / self.lab.grader.name
        return Lab(self.lab.name, course / "labs" / self.lab.name, grader, self.lab.hidden)


@dataclass(frozen=True)
class OwnCards:
    """Whose card each submission is judged by."""

    courses: Courses
    whose: Mapping[str, str]

    def words(self, submission: str) -> dict[str, Plain]:
        """The student's own, of the card."""
        return self.courses.words_of(self.whose[submission])

    def course(self, submission: str) -> Path:
        """The one that the submission is graded by."""
        return self.courses.course(self.words(submission))


def own_cards(
    lab: Lab, students: Sequence[Student], submissions: Sequence[str], folder: Path
) -> OwnCards:
    """The cards of a class. Raises NoVariants, BadCourseFile."""
    if (variants := variants_of(lab)) is None:
        raise NoVariants(lab)
    return OwnCards(Courses(lab, variants, folder), owners(students, submissions))


def owners(students: Sequence[Student], submissions: Sequence[str]) -> dict[str, str]:
    """Submission to whose card counts: the student's, a team's; its own name where nobody knows."""
    found = match(students, submissions)
    listed = {name: listed_as(student) for student, own in found.of_student.items() for name in own}
    teams = {name: team_of(members[0].cells) for name, members in found.teams.items()}
    return {name: teams.get(name) or listed.get(name) or name for name in submissions}


def listed_as(student: Student) -> str:
    """What a student gives to `--for`: number, login, GitHub name, address, or the whole name."""
    cells = student.cells
    number = next((cells[column] for column in NUMBERS if cells.get(column)), "")
    is_own = student.id not in (cells.get(IDENTIFIER), "") and "sis login id" not in cells
    github = next((cells[column] for column in GITHUB if cells.get(column)), "")
    return (
        number
        or (student.id if is_own else "")
        or student.login
        or github
        or student.email
        or student.name
    ).strip()


@contextmanager
def courses_of(lab: Lab) -> Iterator[Courses]:
    """The courses of cards by which was graded before. Raises BadCourseFile."""
    with tempfile.TemporaryDirectory(prefix="roslings-") as folder:
        yield Courses(lab, variants_of(lab), Path(folder))


@contextmanager
def in_course(lab: Lab) -> Iterator[None]:
    """What reads the course by itself, as a grader does, finds this lab while the block runs."""
    before = os.environ.get("ROSLINGS_COURSE")
    os.environ["ROSLINGS_COURSE"] = str(lab.folder.parents[1])
    try:
        yield
    finally:
        os.environ.pop("ROSLINGS_COURSE")
        if before is not None:
            os.environ["ROSLINGS_COURSE"] = before


def write_cards(courses: Courses, students: Sequence[Student], path: Path) -> None:
    """Write who has which words of the card, for each in the class list. Raises CannotWriteFile."""
    whose = {student: team_of(student.cells) or listed_as(student) for student in students}
    words = {student: courses.words_of(owner) for student, owner in whose.items()}
    names = list(courses.variants.words) if courses.variants else []
    rows = (
        (each.name, whose[each], *(as_typed(words[each][name]) for name in names))
        for each in students
    )
    write_lines(path, [("name", "for", *names), *rows])
