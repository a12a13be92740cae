"""The file `.roslings/progress.json`, read and written with the standard library alone.

`./roslings` and `./roslings status` read it at each use: to load pydantic for these few numbers
would take longer than the rest of the command.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field, replace
from datetime import date, datetime, timedelta
from typing import Any

SCHEMA = 1
FULL_SCORE = 100.0
DAYS_KEPT = 400


class DamagedProgress(Exception):
    """The content is no progress of this schema."""


@dataclass(frozen=True)
class LabProgress:
    """How far one lab is."""

    best: float = 0.0
    """0 to 100, as `last` is."""
    last: float = 0.0
    checks: int = 0
    """Gradings that gave a score."""
    best_at: datetime | None = None
    last_at: datetime | None = None
    passed_at: datetime | None = None
    """First time that all passed."""

    @property
    def done(self) -> bool:
        """Every check has passed once."""
        return self.passed_at is not None


@dataclass(frozen=True)
class DrillProgress:
    """How far one drill is."""

    tries: int = 0
    last_at: datetime | None = None
    passed_at: datetime | None = None
    """First time that it was mended."""


@dataclass(frozen=True)
class QuizProgress:
    """How far one day's quiz is."""

    best: int = 0
    """Questions that were right at the first try, in the best round."""
    of: int = 0
    """Questions of that round."""
    last: int = 0
    rounds: int = 0
    last_at: datetime | None = None


@dataclass(frozen=True)
class StudentProgress:
    """The whole file."""

    labs: dict[str, LabProgress] = field(default_factory=dict)
    """The lab's name to how far it is."""
    drills: dict[str, DrillProgress] = field(default_factory=dict)
    """The same of drills."""
    quizzes: dict[str, QuizProgress] = field(default_factory=dict)
    """The day's folder to how far its quiz is."""
    days: list[date] = field(default_factory=list)
    """On which something was checked, in order; the newest `DAYS_KEPT`."""

    def with_day(self, day: date) -> StudentProgress:
        """With one more day on which something was checked."""
        return replace(self, days=sorted({*self.days, day})[-DAYS_KEPT:])

    def days_in_a_row(self, today: date) -> int:
        """Up to today, or up to yesterday where today has not begun."""
        known, last = set(self.days), today if today in self.days else today - timedelta(days=1)
        return next(n for n in range(len(known) + 1) if last - timedelta(days=n) not in known)


def progress_in(content: bytes) -> StudentProgress:
    """The progress that `content` holds; words of a newer roslings are passed over.

    Raises DamagedProgress.
    """
    try:
        tree = json.loads(content)
        if tree.get("schema", SCHEMA) != SCHEMA:
            raise DamagedProgress
        labs = {name: _lab_in(entry) for name, entry in tree.get("labs", {}).items()}
        drills = {name: _drill_in(entry) for name, entry in tree.get("drills", {}).items()}
        quizzes = {day: _quiz_in(entry) for day, entry in tree.get("quizzes", {}).items()}
        return StudentProgress(
            labs, drills, quizzes, [date.fromisoformat(day) for day in tree.get("days", [])]
        )
    except (AttributeError, RecursionError, TypeError, ValueError) as error:
        raise DamagedProgress from error


def as_json(progress: StudentProgress) -> str:
    """The content of the file."""
    tree = {"schema": SCHEMA, **asdict(progress)}
    return json.dumps(tree, indent=2, default=_written) + "\n"


def _written(moment: date) -> str:
    """A date, or a datetime, each in its own way."""
    return moment.isoformat()


def _lab_in(entry: dict[str, Any]) -> LabProgress:
    """Raises ValueError, TypeError or AttributeError where it is none."""
    return LabProgress(
        best=_between(entry.get("best", 0.0), FULL_SCORE),
        last=_between(entry.get("last", 0.0), FULL_SCORE),
        checks=int(_between(entry.get("checks", 0), float("inf"))),
        best_at=_time_in(entry.get("best_at")),
        last_at=_time_in(entry.get("last_at")),
        passed_at=_time_in(entry.get("passed_at")),
    )


def _drill_in(entry: dict[str, Any]) -> DrillProgress:
    """Raises ValueError, TypeError or AttributeError where it is none."""
    return DrillProgress(
        tries=int(_between(entry.get("tries", 0), float("inf"))),
        last_at=_time_in(entry.get("last_at")),
        passed_at=_time_in(entry.get("passed_at")),
    )


def _quiz_in(entry: dict[str, Any]) -> QuizProgress:
    """Raises ValueError, TypeError or AttributeError where it is none."""
    of = int(_between(entry.get("of", 0), float("inf")))
    return QuizProgress(
        best=int(_between(entry.get("best", 0), of)),
        of=of,
        last=int(_between(entry.get("last", 0), float("inf"))),
        rounds=int(_between(entry.get("rounds", 0), float("inf"))),
        last_at=_time_in(entry.get("last_at")),
    )


def _between(number: float, most: float) -> float:
    """A number from 0 to `most`; not-a-number is none."""
    if isinstance(number, bool) or not 0 <= number <= most:
        raise ValueError(number)
    return number


def _time_in(text: str | None) -> datetime | None:
    """Python 3.10 does not know the Z that stands for UTC."""
    return None if text is None else datetime.fromisoformat(text.replace("Z", "+00:00"))
