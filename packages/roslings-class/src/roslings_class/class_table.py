"""The table of a class: one line for each student, sorted and searched by the reader."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from urllib.parse import quote

from ros2_on_pip.markup import Markup, joined, tag
from roslings.report.flow import one_line
from roslings_class.folders import PAGE, folder_of
from roslings_class.grades import UNCLEAR, StudentGrade
from roslings_class.sorted_table import Column, sorted_table


def everybody(grades: Sequence[StudentGrade]) -> Markup:
    """All of them, the lowest score first: these are to be looked at."""
    about = "a name, an outcome, a check that was failed"
    lines = sorted(grades, key=_rank)
    return sorted_table([*_columns(grades)], lines, about, lambda each: " ".join(failed(each)))


def _rank(grade: StudentGrade) -> float:
    return -1.0 if grade.final is None else grade.final


def _columns(grades: Sequence[StudentGrade]) -> Iterator[Column[StudentGrade]]:
    """Only those in which something stands."""
    yield Column("who", "who", _who)
    if any(each.student and each.student.id for each in grades):
        yield Column("id", "id", lambda each: each.student.id if each.student else "")
    yield Column("outcome", "outcome-of", _outcome)
    yield Column("score", "score-of", _score)
    if any(each.late_days for each in grades):
        yield Column("late", "late", lambda each: f"{each.late_days}" if each.late_days else "")
    yield Column("to mend", "mend", _mend, _count)
    if any(map(remark, grades)):
        yield Column("remark", "remark", remark)
    if any(each.student and each.submission for each in grades):
        yield Column("submission", "submission", lambda each: each.submission)


def _who(grade: StudentGrade) -> Markup:
    return page_link(grade.submission, grade.name) if grade.submission else joined(grade.name)


def page_link(submission: str, text: str = "") -> Markup:
    """The way to a student's own page."""
    address = quote((folder_of(Path(), submission) / PAGE).as_posix())
    return tag("a", text or submission, href=address)


def _outcome(grade: StudentGrade) -> Markup:
    return tag("span", grade.outcome, class_=f"outcome {grade.outcome}")


def _score(grade: StudentGrade) -> str:
    return "" if grade.final is None else f"{grade.final:g}"


def failed(grade: StudentGrade) -> list[str]:
    """The checks that failed, in the order of the lab."""
    verdict = grade.result.verdict if grade.result else None
    return [check.id for check in verdict.failed()] if verdict else []


def _mend(grade: StudentGrade) -> str:
    """The first that failed, and how many more."""
    first, *more = failed(grade) or [""]
    if not first:
        return ""
    return joined(tag("code", first), f" +{len(more)}" if more else "")


def _count(grade: StudentGrade) -> str:
    """How many failed; nothing where nobody can say."""
    return f"{len(failed(grade))}" if grade.measured is not None else ""


def remark(grade: StudentGrade) -> str:
    """Why the score is another than the measured one, or why there is none."""
    if grade.override:
        measured = "none" if grade.measured is None else f"{grade.measured:g}"
        who = f"{grade.override.by}: {grade.override.reason}"
        return f"score given by a person (measured: {measured}). {who}"
    if grade.outcome == UNCLEAR:
        return grade.doubt
    costs = grade.late_points if grade.measured is not None else 0.0
    late = f"being late costs {costs:g}. " if costs else ""
    return late + (one_line(grade.result.reason) if grade.result else "")
