"""What being late costs: the deadline, whose deadline is later, and the days."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from datetime import datetime
from pathlib import Path

from pydantic import BaseModel

from ros2_on_pip.typed_paths import from_here
from roslings_class.clock_times import as_time, in_zone, shown, zone_named
from roslings_class.errors import BadTable, BatchError
from roslings_class.moodle_dates import extended_to
from roslings_class.roster import Student, squashed, told_of
from roslings_class.tables import TableRow, read_table

DAY_S = 86_400.0
UNTIL = ("until", "deadline", "due", "extension")
"""Columns of a list of extensions that say until when; the first that is there counts."""


class Extension(BaseModel):
    """Somebody who has more time."""

    who: tuple[str, ...]
    """All that the list says of them: name, id, address."""
    until: datetime

    def is_of(self, student: Student | None, submission: str) -> bool:
        """Whether it is this student's, or this submission's where there is no class list.

        Of two who have one name it is that one whose id or address the list says.
        """
        if student is None:
            return squashed(submission) in map(squashed, self.who)
        return set(map(squashed, self.who)) <= student.named()


class LateRule(BaseModel):
    """What being late costs."""

    deadline: datetime
    points_a_day: float = 0.0
    free_days: int = 0
    """Days late that cost nothing."""
    zone: str = ""
    """In which the times are that name none; empty for the computer's own."""
    extensions: tuple[Extension, ...] = ()

    def deadline_of(self, student: Student | None, submission: str) -> datetime:
        """The instructor's own list first; else what Moodle's worksheet says; else everybody's."""
        for each in self.extensions:
            if each.is_of(student, submission):
                return each.until
        granted = extended_to(student.cells) if student else None
        return in_zone(granted, zone_named(self.zone)) if granted else self.deadline

    def days(self, submitted: datetime, deadline: datetime | None = None) -> int:
        """Days late, each begun one counted; 0 in time."""
        late = submitted - (deadline or self.deadline)
        return max(0, math.ceil(late.total_seconds() / DAY_S))

    def costs(self, days: int) -> float:
        """The points that so many days cost."""
        return self.points_a_day * max(0, days - self.free_days)

    def line(self) -> str:
        """The deadline as it was understood, and whose clock counts where no zone is written."""
        clock = self.zone or "this computer's zone"
        return f"Deadline: {shown(self.deadline)}. A time without a zone is read in {clock}."


def read_extensions(path: Path, zone: str) -> tuple[Extension, ...]:
    """Each line of the list: who, and until when. Raises BadTable, NoSuchZone."""
    return tuple(_extension(row, zone) for row in read_table(path))


def _extension(row: TableRow, zone: str) -> Extension:
    who, text = told_of(row), row.needed(UNTIL)
    if not who:
        step = "Name the student: a column name, id, email or login, as in the class list."
        raise BadTable(row.table, row.line, "it is not said whose extension this is.", step)
    try:
        return Extension(who=who, until=as_time(text, zone_named(zone)))
    except ValueError:
        step = "Write it as 2026-12-03 23:59."
        raise BadTable(row.table, row.line, f"{text!r} is no date and time.", step) from None


class ExtensionOfNobody(BatchError):
    """A line of the list fits no student and no submission."""

    def __init__(self, path: Path, names: Sequence[str]) -> None:
        super().__init__(
            f"{from_here(path)}: nobody in the class is called so: {', '.join(names)}.",
            "Write each as the class list does: the name, the id, the address or the login.",
        )


def insist_on_people(
    path: Path, rule: LateRule, students: Sequence[Student], submissions: Sequence[str]
) -> None:
    """Raises ExtensionOfNobody: more time that reaches nobody would be found out too late."""
    people: list[tuple[Student | None, str]] = [(student, "") for student in students]
    people = people or [(None, name) for name in submissions]
    if strangers := list(_strangers(rule, people)):
        raise ExtensionOfNobody(path, strangers)


def _strangers(rule: LateRule, people: Sequence[tuple[Student | None, str]]) -> Iterator[str]:
    for each in rule.extensions:
        if not any(each.is_of(student, name) for student, name in people):
            yield each.who[0]
