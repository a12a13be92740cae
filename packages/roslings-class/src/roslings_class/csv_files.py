"""The grades as CSV: with all columns, and as Canvas and Moodle read them."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path

from roslings.course import Lab
from roslings.report.flow import one_line
from roslings.report.safe_text import harmless
from roslings.report.whole_file import write_whole
from roslings_class.grades import SAY_WHOSE, Grade
from roslings_class.moodle_worksheet import Mark, Worksheet
from roslings_class.roster import IDENTIFIER

FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""A cell that begins so is run by a spreadsheet: a student's file may be called `=cmd|...`."""
CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
MOODLE = ("Identifier", "Full name", "Email address", "Grade", "Feedback comments")
Line = Sequence[str]


def write_all(
    grades: Sequence[Grade],
    lab: Lab,
    folder: Path,
    assignment: str = "",
    worksheet: Worksheet | None = None,
) -> None:
    """Write grades.csv, canvas.csv and moodle.csv; `assignment` is Canvas's name of the lab.

    With Moodle's own worksheet, moodle.csv is that, filled in; without, it is a table for Moodle's
    gradebook. Raises CannotWrite.
    """
    _write(folder / "grades.csv", _plain(grades, list(lab.card.points)))
    _write(folder / "canvas.csv", _canvas(grades, assignment or f"{lab.card.title} ({lab.name})"))
    if worksheet is None:
        _write(folder / "moodle.csv", _moodle(grades))
    else:
        marks = {_identifier(each): mark for each in grades if (mark := _mark(each))}
        write_whole(folder / "moodle.csv", worksheet.filled(marks))


def _write(path: Path, lines: Iterable[Line]) -> None:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(
        [_safe(cell) for cell in line] for line in lines
    )
    write_whole(path, text.getvalue().encode("utf-8", "replace"))


def _safe(cell: str) -> str:
    text = harmless(cell)
    return f"'{text}" if text.startswith(FORMULA) else text


def _plain(grades: Sequence[Grade], checks: Sequence[str]) -> Iterable[Line]:
    yield (
        "name", "id", "email", "submission", "outcome", "measured", "days late", "late points",
        "final", "reason", *checks,
    )  # fmt: skip
    for each in grades:
        student = each.student
        points = _points(each)
        yield (
            each.name, student.id if student else "", student.email if student else "",
            each.submission, each.outcome, _number(each.measured), _number(each.late_days),
            _number(each.late_points or None), _number(each.final), _reason(each),
            *(_number(points.get(check)) for check in checks),
        )  # fmt: skip


def _points(grade: Grade) -> dict[str, float]:
    if not grade.result or not grade.result.verdict:
        return {}
    return {check.id: check.points for check in grade.result.verdict.checks}


def _reason(grade: Grade) -> str:
    """Why the final score is not the measured one, or why there is none."""
    if grade.override:
        return f"{grade.override.by}: {grade.override.reason}"
    if grade.doubt:
        return f"{grade.doubt} {SAY_WHOSE}"
    return one_line(grade.result.reason) if grade.result else ""


def _canvas(grades: Sequence[Grade], assignment: str) -> Iterable[Line]:
    """A score that is not known stays empty: Canvas then leaves it as it is."""
    yield (*CANVAS, assignment)
    yield ("    Points Possible", "", "", "", "", "100")
    for each in (each for each in grades if each.student):
        assert each.student
        cells = each.student.cells
        own = [cells.get(name.lower(), "") for name in CANVAS[1:]]
        yield (each.student.name, *own, _number(each.final))


def _moodle(grades: Sequence[Grade]) -> Iterable[Line]:
    yield MOODLE
    for each in (each for each in grades if each.student):
        assert each.student
        who = (_identifier(each), each.student.name, each.student.email)
        yield (*who, _number(each.final), _comment(each))


def _identifier(grade: Grade) -> str:
    """What Moodle calls the student in its worksheet; else their number."""
    student = grade.student
    return student.cells.get(IDENTIFIER, student.id).strip() if student else ""


def _mark(grade: Grade) -> Mark | None:
    """What goes into the worksheet; None where a line stays as it is."""
    if grade.student is None or grade.outcome == "missing":
        return None
    if grade.final is None and grade.outcome != "refused":
        return None  # nobody could tell, and why is not the student's
    return Mark(grade.final, _safe(_comment(grade)))


def _comment(grade: Grade) -> str:
    """What to mend first, in a line; the whole of it is on the student's page."""
    if grade.override or not grade.result:
        return _reason(grade)
    if not grade.result.verdict:
        return " ".join(one_line(text) for text in grade.result.told_to_student if text)
    failed = [check.title for check in grade.result.verdict.failed()]
    return f"To mend: {'; '.join(failed)}" if failed else ""


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:g}"
