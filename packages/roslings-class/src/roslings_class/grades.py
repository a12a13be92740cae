"""One grade a student: what was measured, what a person decided, what being late costs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime

from roslings.hand_in.newest import Natural, natural
from roslings_class.gradebook import Gradebook, Override
from roslings_class.handed_in import UNKNOWN, HandedIn, HandInTimes
from roslings_class.late_days import LateRule
from roslings_class.result import GradingResult
from roslings_class.roster import SUBMISSION, RosterMatch, Student, match

UNCLEAR = "unclear"
DIFFERS = "What counts is not the same for all of the team: see your own grade."
SAY_WHOSE = (
    "See on the platform who sent it. Write its name into the class list, in the line of that"
    f" student, column `{SUBMISSION}`, and type the same command again."
)


@dataclass(frozen=True)
class StudentGrade:
    """All that counts for one student, or for one submission where there is no class list."""

    student: Student | None
    result: GradingResult | None
    """None where nothing was handed in."""
    override: Override | None = None
    late_days: int | None = None
    """None where the time of handing in is not known."""
    late_points: float = 0.0
    handed_in: HandedIn = UNKNOWN
    team: tuple[str, ...] = ()
    """Everybody whose hand-in it is, where it is a team's; the one of a team of one, too."""
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
    def late_words(self) -> str:
        """What being late has cost, for the student; empty where it has cost nothing."""
        if not self.late_points or self.override or self.measured is None:
            return ""
        days = "1 day" if self.late_days == 1 else f"{self.late_days} days"
        return f"Handed in {days} late: {self.late_points:g} points less."

    @property
    def counts(self) -> str:
        """What counts for the student beside the measured score; empty where that is all."""
        if self.override:
            by = self.override
            return f"{by.score:g} of 100 count, by {by.by}: {by.reason}"
        return f"{self.late_words} {self.final:g} of 100 count." if self.late_words else ""

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

    grades: list[StudentGrade]
    unknown: list[str] = field(default_factory=list)
    twice: dict[str, list[str]] = field(default_factory=dict)
    """Students with several submissions, of which the newest that was graded counts."""

    @property
    def missing(self) -> list[StudentGrade]:
        """Who handed in nothing."""
        return [grade for grade in self.grades if grade.outcome == "missing"]

    @property
    def counts(self) -> dict[str, str]:
        """Submission to what counts beside its score; in a team it may differ."""
        found: dict[str, str] = {}
        for grade in self.grades:
            if grade.result and found.setdefault(grade.submission, grade.counts) != grade.counts:
                found[grade.submission] = DIFFERS
        return found

    @property
    def teams(self) -> dict[str, tuple[str, ...]]:
        """Submissions of several students, and who has each of them."""
        return {grade.submission: grade.team for grade in self.grades if len(grade.team) > 1}

    @property
    def unclear(self) -> list[StudentGrade]:
        """Submissions of which nobody can say whose they are."""
        return [grade for grade in self.grades if grade.may_be_of]


def class_of(
    book: Gradebook,
    times: HandInTimes | dict[str, datetime],
    students: Sequence[Student] = (),
    rule: LateRule | None = None,
) -> Class:
    """Join the gradebook, the times of handing in, the class list and the rule on being late."""
    latest = book.latest()
    times = times if isinstance(times, HandInTimes) else HandInTimes(times)
    join = _Join(latest, book.overrides(), times, rule)
    if not students:
        return Class([join.grade(None, name) for name in latest])
    found = match(students, latest)
    twice = {student.name: names for student, names in found.of_student.items() if len(names) > 1}
    return Class(list(join.grades(found)), found.unknown, twice)


@dataclass(frozen=True)
class _Join:
    latest: dict[str, GradingResult]
    overrides: dict[str, Override]
    times: HandInTimes
    rule: LateRule | None

    def grades(self, found: RosterMatch) -> Iterable[StudentGrade]:
        for student, names in found.of_student.items():
            if names:
                own = self.grade(student, self._newest(student, names))
                team = tuple(_told_apart(found.teams.get(own.submission, ())))
                yield replace(own, team=team)
            else:
                yield StudentGrade(student, None, may_have_sent=tuple(found.doubts(student)))
        for name in found.unknown:
            yield self.grade(None, name)
        for name, owners in found.unclear.items():
            may_be_of = tuple(_told_apart(owners))
            yield replace(self.grade(None, name), may_be_of=may_be_of)

    def grade(self, student: Student | None, name: str) -> StudentGrade:
        handed_in = self.times.of(student, name)
        days = self._days(student, name, handed_in)
        costs = self.rule.costs(days) if self.rule and days else 0.0
        return StudentGrade(
            student, self.latest[name], self.overrides.get(name), days, costs, handed_in
        )

    def _days(self, student: Student | None, name: str, handed_in: HandedIn) -> int | None:
        """None where nobody tells the time; 0 where a platform says that it was in time."""
        if self.rule is None or handed_in.gap:
            return None
        if handed_in.at is None:
            return 0
        return self.rule.days(handed_in.at, self.rule.deadline_of(student, name))

    def _newest(self, student: Student, names: list[str]) -> str:
        """A person's word first; what was refused never stands before what was graded."""
        return max(names, key=lambda name: self._rank(student, name))

    def _rank(self, student: Student, name: str) -> tuple[bool, bool, float, Natural]:
        was_graded = self.latest[name].word != "refused"
        submitted = self.times.of(student, name).at
        stamp = submitted.timestamp() if submitted else 0.0
        return name in self.overrides, was_graded, stamp, natural(name)


def _told_apart(students: Sequence[Student]) -> Iterable[str]:
    """Their names; with the id where two have one name."""
    for student in students:
        twins = sum(each.name == student.name for each in students)
        yield f"{student.name} ({student.id})" if twins > 1 and student.id else student.name
