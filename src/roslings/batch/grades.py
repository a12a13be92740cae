"""One grade a student: what was measured, what a person decided, what being late costs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from datetime import datetime

from pydantic import BaseModel

from roslings.batch.gradebook import Gradebook, Override
from roslings.batch.newest import Natural, natural
from roslings.batch.result import Result
from roslings.batch.roster import Matched, Student, match

DAY_S = 86_400.0


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
        """pass, fail, refused, inconclusive or missing."""
        return self.result.word if self.result else "missing"

    @property
    def measured(self) -> float | None:
        """The score of the verdict."""
        return self.result.score if self.result else None

    @property
    def final(self) -> float | None:
        """0 to 100; a person's score stands as it is. None where there is nothing to count."""
        if self.override:
            return self.override.score
        if self.measured is None:
            return None
        return max(0.0, round(self.measured - self.late_points, 1))


@dataclass(frozen=True)
class Class:
    """The grades of a class, and what does not fit the class list."""

    grades: list[Grade]
    unknown: list[str] = field(default_factory=list)
    unclear: dict[str, list[str]] = field(default_factory=dict)
    twice: dict[str, list[str]] = field(default_factory=dict)
    """Students with several submissions, of which the newest that was graded counts."""

    @property
    def missing(self) -> list[Grade]:
        """Who handed in nothing."""
        return [grade for grade in self.grades if grade.result is None]


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
    return Class(list(join.grades(found)), found.unknown, found.unclear, twice)


@dataclass(frozen=True)
class _Join:
    latest: dict[str, Result]
    overrides: dict[str, Override]
    times: dict[str, datetime]
    rule: LateRule | None

    def grades(self, found: Matched) -> Iterable[Grade]:
        for student, names in found.of_student.items():
            yield self.grade(student, self._newest(names)) if names else Grade(student, None)
        for name in (*found.unknown, *found.unclear):
            yield self.grade(None, name)

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
