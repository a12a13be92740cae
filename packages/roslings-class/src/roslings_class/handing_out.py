"""Everything that an instructor takes away, made from the gradebook alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from datetime import datetime
from pathlib import Path

from pydantic import BaseModel

from ros2_on_pip.typed_paths import from_here
from roslings.course import Lab
from roslings_class.canvas_list import points_of_assignments
from roslings_class.changes import FILE, last_regrading
from roslings_class.class_page import write_class_page
from roslings_class.csv_files import WHOLE, write_all, write_changes
from roslings_class.feedback import DownloadedHandIn, Feedback
from roslings_class.fingerprints import fingerprint
from roslings_class.folders import STUDENTS
from roslings_class.gradebook import Gradebook
from roslings_class.grades import SAY_WHOSE, Class, StudentGrade, class_of
from roslings_class.handed_in import LATE_BY_SOME, NOT_KNOWN, HandInTimes, ToldHandIn
from roslings_class.late_days import LateRule
from roslings_class.messages import few as _few
from roslings_class.messages import wrapped as _wrapped
from roslings_class.moodle_worksheet import read_worksheet
from roslings_class.own_cards import FILE as CARDS
from roslings_class.own_cards import Courses, courses_of, write_cards
from roslings_class.roster import Student, read_roster
from roslings_class.student_pages import write_pages

KEY = "handout"


class Settings(BaseModel):
    """What `grade` was told last; an override or a regrade writes everything anew by it."""

    roster: Path | None = None
    rule: LateRule | None = None
    times: dict[str, datetime] = {}
    """Submission to the time of handing in, where a list told it."""
    told: tuple[ToldHandIn, ...] = ()
    """The same, from files of `--times` and from the submissions themselves."""
    hidden: Path | None = None
    """The checks that students do not have."""
    given: dict[str, DownloadedHandIn] = {}
    """Submission to what it was called in the download."""
    assignment: str = ""
    """What Canvas calls the lab: the head of its column; empty for the lab's own title."""
    points: float | None = None
    """What the whole is worth on the platform; None: as the class list says, or 100."""
    variants: bool = False
    """Whether each student has a card of their own."""

    def without(self, submission: str) -> Settings:
        """The same, where nothing is kept of it."""
        return self.model_copy(
            update={
                "times": {each: at for each, at in self.times.items() if each != submission},
                "told": tuple(each for each in self.told if each.submission != submission),
                "given": {each: as_ for each, as_ in self.given.items() if each != submission},
            }
        )

    def known_times(self) -> HandInTimes:
        """When each was handed in, from all that is known."""
        return HandInTimes(self.times, self.rule.zone if self.rule else "").add(self.told)


def settings_of(book: Gradebook) -> Settings:
    """The settings that the gradebook keeps."""
    kept = book.about(KEY)
    return Settings.model_validate_json(kept) if kept else Settings()


def keep(book: Gradebook, settings: Settings) -> None:
    """Keep settings for later commands."""
    book.note(KEY, settings.model_dump_json())


def hand_out(book: Gradebook, lab: Lab, folder: Path) -> list[str]:
    """Write the CSV files, a page for each student and one for the class; what is to be known.

    Raises BadTable where the class list cannot be read, and CannotWriteFile.
    """
    settings = settings_of(book)
    students = read_roster(settings.roster) if settings.roster else ()
    found = class_of(book, settings.known_times(), students, settings.rule)
    worksheet = read_worksheet(settings.roster) if settings.roster else None
    assignments = points_of_assignments(settings.roster) if settings.roster else {}
    whole = settings.points or assignments.get(settings.assignment.strip()) or WHOLE
    write_all(found.grades, lab, folder, settings.assignment, worksheet, whole)
    with courses_of(lab) as courses:
        write_pages(book, courses, found, folder / STUDENTS)
        cards = _cards(courses, students, folder) if settings.variants and courses.variants else []
    feedback = Feedback(lab, folder, settings.given, found.counts, worksheet is not None)
    regrading = last_regrading(book)
    if regrading:
        write_changes(regrading, found.grades, folder / FILE)
    write_class_page(lab, found, _given_marks(lab), folder / "class.html", regrading)
    back = [f"To upload as Moodle's worksheet: {from_here(folder)}/moodle.csv"] if worksheet else []
    return [
        *cards,
        *_remarks(found, settings),
        *_about_assignment(settings, assignments),
        *back,
        *feedback.write(found),
        f"The class on one page: {from_here(folder)}/class.html",
    ]


def _given_marks(lab: Lab) -> frozenset[int]:
    """Of what everybody began with; nothing, where a lab gives nothing."""
    return fingerprint(lab.starter).marks if lab.starter.is_dir() else frozenset()


def _cards(courses: Courses, students: Sequence[Student], folder: Path) -> list[str]:
    write_cards(courses, students, folder / CARDS)
    return [f"Whose card says what: {from_here(folder)}/{CARDS}"]


def _remarks(found: Class, settings: Settings) -> list[str]:
    lines = []
    if found.teams:
        teams = (f"{name} ({len(members)})" for name, members in found.teams.items())
        lines.append(_few("One hand-in for all of a team", list(teams)))
    if found.missing:
        lines.append(_few("Handed in nothing", [grade.name for grade in found.missing]))
    if found.unknown:
        lines.append(_few("Of nobody in the class list", found.unknown))
    if found.unclear:
        lines.append(_few("Unclear whose", [grade.submission for grade in found.unclear]))
        lines.append(_wrapped(f"  {SAY_WHOSE}"))
    if found.twice:
        lines.append(
            _few("Handed in several, the newest that was graded counts", list(found.twice))
        )
    return [*lines, *(_late(found.grades, settings.rule) if settings.rule else ())]


TIMES_FROM = (
    "Nobody is charged for what is not known. To tell it: --times FILE, a CSV file with the columns"
    " student, submitted, or Canvas's list of submissions; or Moodle's worksheet as the class list."
)


def _late(grades: Sequence[StudentGrade], rule: LateRule) -> Iterator[str]:
    """Whose deadline it was, who was late, and of whom nobody can tell."""
    yield rule.line()
    handed_in = [grade for grade in grades if grade.result]
    late = [f"{each.name} ({each.late_days})" for each in handed_in if each.late_days]
    if late:
        yield _few("Late, in days", late)
    gaps = {
        NOT_KNOWN: "When it was handed in is not known",
        LATE_BY_SOME: LATE_BY_SOME.capitalize(),
    }
    for gap, label in gaps.items():
        if names := [each.name for each in handed_in if each.handed_in.gap == gap]:
            yield _few(label, names)
    if any(each.handed_in.gap for each in handed_in):
        yield _wrapped(f"  {TIMES_FROM}")


def _about_assignment(settings: Settings, known: Mapping[str, float | None]) -> list[str]:
    """Canvas makes a new column of a name that it does not know."""
    name = settings.assignment.strip()
    if not known or known.get(name) or (name in known and settings.points):
        return []
    if name in known:
        return [f"{name!r} has no points in the class list: 100 are taken (--points N)."]
    called = f"No assignment is called {name!r}" if name else "No --canvas-assignment was given"
    problem = _wrapped(f"{called}: with canvas.csv, Canvas would make a new column.")
    return [problem, _few("Its assignments", [*known])]
