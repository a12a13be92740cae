"""One grade a student: what was measured, what a person decided, what being late costs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime

from pydantic import BaseModel

from roslings.hand_in.newest import Natural, natural
from roslings_class.gradebook import Gradebook, Override
from roslings_class.result import Result
from roslings_class.roster import SUBMISSION, Matched, Student, match

DAY_S = 86_400.0
UNCLEAR = "unclear"
SAY_WHOSE = (
    "See on the platform who sent it. Write its name into the class list, in the line of that"
    f" student, column `{SUBMISSION}`, and type the same command again."
)


class LateRule(BaseModel):
    """What being late costs."""

    deadline: datetime
    points_a_day: float = 0.0
    free_days: int = 0
    """Days late that cost nothing."""

    def days(self, submitted: datetime) -> int:
        """Days late, each begun one counted; 0 in time."""
        return max(0, math.ceil((submitted - self.deadline).total_seconds() / DAY_S))

    def costs(self, days: int) -> float:
        """The points that so many days cost."""
        return self.points_a_day * max(0, days - self.free_days)


@dataclass(frozen=True)
class Grade:
    """All that counts for one student, or for one submission where there is no class list."""

    student: Student | None
    result: Result | None
    """None where nothing was handed in."""
    override: Override | None = None
    late_days: int | None = None
    """None where the time of handing in is not known."""
    late_points: float = 0.0
    may_have_sent: tuple[str, ...] = ()
    """Submissions that may be of this student, where none is for sure."""
    may_be_of: tuple[str, ...] = ()
    """Students who may have sent this submission, where nobody can say who did."""

    @property
    def name(self) -> str:
        """Who."""
        return self.student.name if self.student else self.submission

    @property
    def submission(self) -> str:
        """Which submission; empty where there is none."""
        return self.result.submission if self.result else ""

    @property
    def outcome(self) -> str:
        """pass, fail, refused, inconclusive, missing, or unclear: whose it is."""
        if self.may_have_sent or self.may_be_of:
            return UNCLEAR
        return self.result.word if self.result else "missing"

    @property
    def doubt(self) -> str:
        """Why it is unclear whose it is; empty where it is not."""
        if self.may_have_sent:
            return f"May have sent {' or '.join(self.may_have_sent)}."
        if len(self.may_be_of) == 1:
            return f"May be of {self.may_be_of[0]}, or of somebody called so."
        return f"May be of {' or '.join(self.may_be_of)}." if self.may_be_of else ""

    @property
    def measured(self) -> float | None:
        """The score of the verdict."""
        return self.result.score if self.result else None

    @property
    def final(self) -> float | None:
        """0 to 100; a person's score stands as it is. None where there is nothing to count."""
        if self.override:
            return self.override.score
        if self.measured is None or self.outcome == UNCLEAR:
            return None
        return max(0.0, round(self.measured - self.late_points, 1))


@dataclass(frozen=True)
class Class:
    """The grades of a class, and what does not fit the class list."""

    grades: list[Grade]
    unknown: list[str] = field(default_factory=list)
    twice: dict[str, list[str]] = field(default_factory=dict)
    """Students with several submissions, of which the newest that was graded counts."""

    @property
    def missing(self) -> list[Grade]:
        """Who handed in nothing."""
        return [grade for grade in self.grades if grade.outcome == "missing"]

    @property
    def unclear(self) -> list[Grade]:
        """Submissions of which nobody can say whose they are."""
        return [grade for grade in self.grades if grade.may_be_of]


def class_of(
    book: Gradebook,
    times: dict[str, datetime],
    students: Sequence[Student] = (),
    rule: LateRule | None = None,
) -> Class:
    """Join the gradebook, the times of handing in, the class list and the rule on being late."""
    latest = book.latest()
    join = _Join(latest, book.overrides(), times, rule)
    if not students:
        return Class([join.grade(None, name) for name in latest])
    found = match(students, latest)
    twice = {student.name: names for student, names in found.of_student.items() if len(names) > 1}
    return Class(list(join.grades(found)), found.unknown, twice)


@dataclass(frozen=True)
class _Join:
    latest: dict[str, Result]
    overrides: dict[str, Override]
    times: dict[str, datetime]
    rule: LateRule | None

    def grades(self, found: Matched) -> Iterable[Grade]:
        for student, names in found.of_student.items():
            if names:
                yield self.grade(student, self._newest(names))
            else:
                yield Grade(student, None, may_have_sent=tuple(found.doubts(student)))
        for name in found.unknown:
            yield self.grade(None, name)
        for name, owners in found.unclear.items():
            may_be_of = tuple(_told_apart(owners))
            yield replace(self.grade(None, name), may_be_of=may_be_of)

    def grade(self, student: Student | None, name: str) -> Grade:
        submitted = self.times.get(name)
        days = self.rule.days(submitted) if self.rule and submitted else None
        costs = self.rule.costs(days) if self.rule and days else 0.0
        return Grade(student, self.latest[name], self.overrides.get(name), days, costs)

    def _newest(self, names: list[str]) -> str:
        """A person's word first; what was refused never stands before what was graded."""
        return max(names, key=self._rank)

    def _rank(self, name: str) -> tuple[bool, bool, float, Natural]:
        was_graded = self.latest[name].word != "refused"
        return name in self.overrides, was_graded, self._stamp(name), natural(name)

    def _stamp(self, name: str) -> float:
        submitted = self.times.get(name)
        return submitted.timestamp() if submitted else 0.0


def _told_apart(students: Sequence[Student]) -> Iterable[str]:
    """Their names; with the id where two have one name."""
    for student in students:
        twins = sum(each.name == student.name for each in students)
        yield f"{student.name} ({student.id})" if twins > 1 and student.id else student.name
