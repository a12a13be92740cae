"""When each was handed in, from where that is known.

The surest first:

| source | what it tells | whose word it is |
| --- | --- | --- |
| a CSV file of the submissions | `submitted` | the instructor's |
| `--times`: Canvas's submissions, the JSON of its API | `submitted_at`, `late` | Canvas's |
| `--times` or the class list: GitHub Classroom's grades | `submission_timestamp` | GitHub's |
| the class list: Moodle's grading worksheet | `Last modified (submission)` | Moodle's |
| a clone | the date of its newest commit | the student's own computer's |
| a file's name in Canvas's download | `LATE` or not, not by how much | Canvas's |

What tells nothing: the date of a file, and that of an entry in a platform's zip. Both are of the
download. Sources: canvas-lms, lib/content_zipper.rb, and its API's Submission object, before which
a browser gets `while(1);`; gh-classroom, cmd/gh-classroom/assignment-grades; see moodle_dates.py.
"""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from datetime import datetime, timezone, tzinfo
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict

from roslings_class.clock_times import as_time, in_zone, zone_named
from roslings_class.commit_times import commit_time
from roslings_class.errors import BadTable
from roslings_class.moodle_dates import submitted_at
from roslings_class.platform_names import CANVAS, told_by_platform
from roslings_class.roster import SUBMISSION, Student, repository_of, squashed, told_of
from roslings_class.submissions import TIMES, Submission
from roslings_class.tables import MOST_BYTES, TableRow, read_table

GUARD = "while(1);"
"""Canvas writes it before the JSON that it gives to a browser."""
CLASSROOM = "submission_timestamp"
"""A column of GitHub Classroom's grades; in UTC where it names no zone."""
LISTED, WORKSHEET, CANVAS_SAYS = "the list of submissions", "Moodle's worksheet", "Canvas"
GITHUB_SAYS, COMMIT, MARKED = "GitHub Classroom", "its newest commit", "Canvas's file name"
NOT_KNOWN = "not known"
LATE_BY_SOME = "late, by how much is not known"


class HandedIn(BaseModel):
    """When something was handed in, and who says so."""

    model_config = ConfigDict(frozen=True)

    source: str
    at: datetime | None = None
    is_late: bool | None = None
    """What a platform says by its own due date, where it tells no time."""

    @property
    def gap(self) -> str:
        """What is missing to count late days; empty where nothing is."""
        if self.at or self.is_late is False:
            return ""
        return LATE_BY_SOME if self.is_late else NOT_KNOWN


UNKNOWN = HandedIn(source="")


class ToldHandIn(HandedIn):
    """The same, of whom or of what a source says it."""

    submission: str = ""
    who: tuple[str, ...] = ()
    number: str = ""
    """Of the student on the platform."""


def told_at(files: Iterable[Path], zone: str) -> tuple[ToldHandIn, ...]:
    """All that the files of `--times` say. Raises BadTable, NoSuchZone."""
    own = zone_named(zone)
    return tuple(told for path in files for told in _read(path, own))


def told_by_itself(submissions: Iterable[Submission]) -> tuple[ToldHandIn, ...]:
    """What the submissions say of themselves: their commits, and the platform's mark."""
    found = list(submissions)
    marks = _marked([each.name for each in found])
    committed = ((each.name, commit_time(each.path)) for each in found)
    commits = (
        ToldHandIn(submission=name, source=COMMIT, at=time) for name, time in committed if time
    )
    return (*marks.values(), *commits)


def _marked(names: Sequence[str]) -> dict[str, ToldHandIn]:
    """Only where some are marked: Canvas marks nobody where an assignment has no due date."""
    told = told_by_platform(names)
    canvas = {name: each for name, each in told.items() if each.platform == CANVAS}
    if not any(each.is_late for each in canvas.values()):
        return {}
    return {
        name: ToldHandIn(submission=name, source=MARKED, is_late=each.is_late)
        for name, each in canvas.items()
    }


# --- the files of --times ----------------------------------------------------------------------


def _read(path: Path, zone: tzinfo | None) -> Iterator[ToldHandIn]:
    if path.suffix.lower() == ".json":
        yield from map(_of_canvas, _submissions_in(path))
        return
    rows = read_table(path)
    if rows and not {CLASSROOM, *TIMES} & set(rows[0].cells):
        step = (
            f"It needs a column {TIMES[0]}, and one that names the student: name, id, email.\n"
            "Moodle's worksheet is given as the class list: --roster"
        )
        raise BadTable(path, 1, "no column says when something was handed in.", step)
    yield from (told for row in rows if (told := _of_row(row, zone)).at)


def _submissions_in(path: Path) -> list[dict[str, Any]]:
    try:
        text = path.read_bytes()[:MOST_BYTES].decode("utf-8").strip()
        found = json.loads(text.removeprefix(GUARD))
    except (OSError, ValueError) as error:
        raise _no_list(path, f"it cannot be read ({error})") from error
    if not isinstance(found, list) or not all(isinstance(each, dict) for each in found):
        raise _no_list(path, "this is no list of submissions")
    return found


def _no_list(path: Path, problem: str) -> BadTable:
    step = "Save Canvas's page /api/v1/courses/COURSE/assignments/NUMBER/submissions?per_page=100"
    return BadTable(path, 1, f"{problem}.", f"{step}\nas it is, each page of it as one file.")


def _of_canvas(entry: dict[str, Any]) -> ToldHandIn:
    """One Submission object; who handed in nothing has no time in it."""
    at, late = entry.get("submitted_at"), entry.get("late")
    try:
        time = as_time(at, timezone.utc) if isinstance(at, str) else None
    except ValueError:
        time = None
    number = str(entry.get("user_id") or "")
    is_late = late if isinstance(late, bool) and at else None
    return ToldHandIn(source=CANVAS_SAYS, number=number, at=time, is_late=is_late)


def _of_row(row: TableRow, zone: tzinfo | None) -> ToldHandIn:
    repository = repository_of(row.cells)
    text = row.first((CLASSROOM, *TIMES))
    source = GITHUB_SAYS if CLASSROOM in row.cells else LISTED
    return ToldHandIn(
        submission=repository or row.first((SUBMISSION,)),
        who=told_of(row),
        source=source,
        at=_time(row, text, timezone.utc if CLASSROOM in row.cells else zone),
    )


def _time(row: TableRow, text: str, zone: tzinfo | None) -> datetime | None:
    try:
        return as_time(text, zone) if text else None
    except ValueError:
        step = "Write it as 2026-11-30 23:59."
        raise BadTable(row.table, row.line, f"{text!r} is no date and time.", step) from None


# --- of whom? ----------------------------------------------------------------------------------


@dataclass
class HandInTimes:
    """All that is known of when submissions were handed in; the surest source counts."""

    listed: dict[str, datetime]
    """Submission to its time, in the CSV file of the submissions."""
    zone: str = ""
    _by_name: defaultdict[str, list[ToldHandIn]] = field(default_factory=lambda: defaultdict(list))
    _by_person: defaultdict[str, list[ToldHandIn]] = field(
        default_factory=lambda: defaultdict(list)
    )
    _by_number: defaultdict[str, list[ToldHandIn]] = field(
        default_factory=lambda: defaultdict(list)
    )
    _itself: dict[str, ToldHandIn] = field(default_factory=dict)

    def add(self, told: Iterable[ToldHandIn]) -> HandInTimes:
        """What `--times` and the submissions themselves say."""
        for each in told:
            if each.source in (COMMIT, MARKED):
                self._itself[each.submission] = each
                continue
            self._by_name[each.submission].append(each)
            self._by_number[each.number].append(each)
            for who in each.who:
                self._by_person[squashed(who)].append(each)
        return self

    def of(self, student: Student | None, submission: str) -> HandedIn:
        """When this submission of this student was handed in."""
        if submission in self.listed:
            return HandedIn(source=LISTED, at=self.listed[submission])
        told = self._by_name.get(submission) or self._of_account(submission)
        if told := told or self._of_student(student):
            return max(told, key=lambda each: each.at.timestamp() if each.at else 0.0)
        listed = self._in_class_list(student) if student else None
        return listed or self._itself.get(submission) or UNKNOWN

    def _of_account(self, submission: str) -> list[ToldHandIn]:
        """By the number that Canvas writes into a file's name."""
        told = told_by_platform([submission]).get(submission)
        return self._by_number.get(told.number, []) if told and told.platform == CANVAS else []

    def _of_student(self, student: Student | None) -> list[ToldHandIn]:
        if student is None:
            return []
        numbered = [self._by_number.get(number, []) for number in student.numbers()]
        if any(numbered):
            return [each for some in numbered for each in some]
        keys = student.named()
        named = (each for key in keys for each in self._by_person.get(key, []))
        return [each for each in named if set(map(squashed, each.who)) <= keys]

    def _in_class_list(self, student: Student) -> HandedIn | None:
        """Moodle's worksheet, and GitHub Classroom's grades, tell it beside each student."""
        if time := submitted_at(student.cells):
            return HandedIn(source=WORKSHEET, at=in_zone(time, zone_named(self.zone)))
        text = student.cells.get(CLASSROOM, "").strip()
        try:
            return HandedIn(source=GITHUB_SAYS, at=as_time(text, timezone.utc)) if text else None
        except ValueError:
            return None
