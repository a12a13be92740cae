"""What a regrade changed: whose submission, which check, from what to what."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from datetime import datetime, timezone
from pathlib import Path

from pydantic import BaseModel

from ros2_on_pip.safe_text import harmless
from ros2_on_pip.typed_paths import from_here
from roslings.verdict import CheckResult, Verdict
from roslings_class.gradebook import Gradebook
from roslings_class.grades import StudentGrade

CHANGED_LAST = "regraded"
"""The gradebook's fact about the last regrade that changed anything."""
FILE = "regraded.csv"
MOST_NAMED = 10
NOT_THERE = "not asked"
SCORE = "score"
"""In place of a check's name: the whole."""


class GradeChange(BaseModel):
    """One check, or the score, of one submission."""

    submission: str
    check: str
    before: str
    after: str


class Regrading(BaseModel):
    """A regrade and all that it changed."""

    at: datetime
    judged: int
    """How many submissions were judged again."""
    changes: list[GradeChange]

    @property
    def summary(self) -> str:
        """When, and how many it changed."""
        when = f"{self.at.astimezone(timezone.utc):%Y-%m-%d %H:%M} UTC"
        count = len({change.submission for change in self.changes})
        checks = sum(change.check != SCORE for change in self.changes)
        return f"{when}. Judged: {self.judged}. Changed: {count}, in {checks} checks together."

    def told(self, grades: Sequence[StudentGrade]) -> Iterator[tuple[str, GradeChange]]:
        """Each change with the name of whose it is."""
        owners: defaultdict[str, list[str]] = defaultdict(list)
        for grade in grades:
            owners[grade.submission].append(grade.name)
        for change in self.changes:
            yield ", ".join(owners[change.submission]) or change.submission, change


def changes(submission: str, before: Verdict, after: Verdict) -> Iterator[GradeChange]:
    """What is another in a verdict of the same evidence, the score first."""
    if before.score != after.score:
        yield GradeChange(
            submission=submission, check=SCORE, before=_score(before), after=_score(after)
        )
    was = {check.id: check for check in before.checks}
    now = {check.id: check for check in after.checks}
    for name in {**was, **now}:
        told = [_told(checks.get(name)) for checks in (was, now)]
        if told[0] != told[1]:
            yield GradeChange(submission=submission, check=name, before=told[0], after=told[1])


def changed_lines(regrading: Regrading, grades: Sequence[StudentGrade], folder: Path) -> list[str]:
    """The first of them for the terminal, and where all are."""
    told = [
        f"  {harmless(who)}: {each.check}, {each.before} -> {each.after}"
        for who, each in regrading.told(grades)
    ]
    if not told:
        return []
    more = len(told) - MOST_NAMED
    rest = [f"  and {more} more"] if more > 0 else []
    return [*told[:MOST_NAMED], *rest, f"All of them: {from_here(folder / FILE)}"]


def last_regrading(book: Gradebook) -> Regrading | None:
    """The last that changed anything."""
    kept = book.about(CHANGED_LAST)
    return Regrading.model_validate_json(kept) if kept else None


def _score(verdict: Verdict) -> str:
    return "none" if verdict.score is None else f"{verdict.score:g}"


def _told(check: CheckResult | None) -> str:
    return f"{check.outcome}, {check.points:g} of {check.max_points:g}" if check else NOT_THERE
