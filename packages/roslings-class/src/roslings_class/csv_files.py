"""The grades as CSV: with all columns, and as Canvas and Moodle read them.

This is what Canvas's importer asks for (canvas-lms, lib/gradebook_importer.rb). It asks for commas,
UTF-8 without a mark, a header, and a line `Points Possible`. The header's first two cells hold
`Student` and `ID`. Then come `SIS User ID`, `SIS Login ID`, and `Section` last before the
assignments. A student is found by the ID, else by the SIS User ID, the SIS Login ID, the name. An
assignment is found by the number in brackets behind its name, else by its name; else a new one is
made. **An empty cell takes away the score that was there**, so who has no score has no line. Who
has no line keeps what was there.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path

from ros2_on_pip.safe_text import harmless
from roslings.course import Lab
from roslings.report.flow import one_line
from roslings.report.shown_checks import shown_checks
from roslings.report.whole_file import write_whole
from roslings_class.changes import Regrading
from roslings_class.grades import SAY_WHOSE, StudentGrade
from roslings_class.moodle_worksheet import Mark, Worksheet
from roslings_class.roster import IDENTIFIER

FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""A cell that begins so is run by a spreadsheet: a student's file may be called `=cmd|...`."""
CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
MOODLE = ("Identifier", "Full name", "Email address", "Grade", "Feedback comments")
WHOLE = 100.0
Line = Sequence[str]


def write_all(
    grades: Sequence[StudentGrade],
    lab: Lab,
    folder: Path,
    assignment: str = "",
    worksheet: Worksheet | None = None,
    whole: float = WHOLE,
) -> None:
    """Write grades.csv, canvas.csv and moodle.csv; `assignment` is Canvas's name of the lab.

    `whole` are the points that the platform gives for a score of 100. With Moodle's own worksheet,
    moodle.csv is that, filled in, in its own points; without, it is a table for Moodle's gradebook.
    Raises CannotWriteFile.
    """
    write_lines(folder / "grades.csv", _plain(grades, list(lab.card.points), whole))
    title = assignment or f"{lab.card.title} ({lab.name})"
    write_lines(folder / "canvas.csv", _canvas(grades, title, whole))
    if worksheet is None:
        write_lines(folder / "moodle.csv", _moodle(grades, whole))
    else:
        marks = {_identifier(each): mark for each in grades if (mark := _mark(each))}
        write_whole(folder / "moodle.csv", worksheet.filled(marks))


def write_changes(regrading: Regrading, grades: Sequence[StudentGrade], path: Path) -> None:
    """Write what the last regrade changed. Raises CannotWriteFile."""
    told = regrading.told(grades)
    lines = [(who, each.submission, each.check, each.before, each.after) for who, each in told]
    write_lines(path, [("name", "submission", "check", "from", "to"), *lines])


def write_lines(path: Path, lines: Iterable[Line]) -> None:
    """Write a table in which no cell is a formula. Raises CannotWriteFile."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(
        [_safe(cell) for cell in line] for line in lines
    )
    write_whole(path, text.getvalue().encode("utf-8", "replace"))


def _safe(cell: str) -> str:
    text = harmless(cell)
    return f"'{text}" if text.startswith(FORMULA) else text


def _plain(grades: Sequence[StudentGrade], checks: Sequence[str], whole: float) -> Iterable[Line]:
    yield (
        "name",
        "id",
        "email",
        "team",
        "submission",
        "outcome",
        "measured",
        "handed in",
        "told by",
        "days late",
        "late points",
        "final",
        "points",
        "of",
        "reason",
        *checks,
    )
    for each in grades:
        student = each.student
        points = _points(each)
        yield (
            each.name,
            student.id if student else "",
            student.email if student else "",
            _team(each),
            each.submission,
            each.outcome,
            _number(each.measured),
            *_handed_in(each),
            _number(each.late_days),
            _number(each.late_points or None),
            _number(each.final),
            _scaled(each, whole),
            _number(whole),
            _reason(each),
            *(_number(points.get(check)) for check in checks),
        )


def _team(grade: StudentGrade) -> str:
    return "; ".join(grade.team) if len(grade.team) > 1 else ""


def _handed_in(grade: StudentGrade) -> tuple[str, str]:
    """When, and who says so; what is missing where days cannot be counted."""
    told = grade.handed_in
    if grade.result is None:
        return "", ""
    return told.at.isoformat(" ", "minutes") if told.at else told.gap or "in time", told.source


def _points(grade: StudentGrade) -> dict[str, float]:
    if not grade.result or not grade.result.verdict:
        return {}
    return {check.id: check.points for check in grade.result.verdict.checks}


def _reason(grade: StudentGrade) -> str:
    """Why the final score is not the measured one, or why there is none."""
    if grade.override:
        return f"{grade.override.by}: {grade.override.reason}"
    if grade.doubt:
        return f"{grade.doubt} {SAY_WHOSE}"
    return _whole_reason(grade.result.reason, grade.result.next_step) if grade.result else ""


def _whole_reason(*texts: str) -> str:
    """What is, and what to do: all of it, in one cell."""
    return " ".join(one_line(text) for text in texts if text)


def _canvas(grades: Sequence[StudentGrade], assignment: str, whole: float) -> Iterable[Line]:
    """Only who has a score: an empty cell would take away one that somebody gave in Canvas."""
    yield (*CANVAS, assignment)
    yield ("    Points Possible", "", "", "", "", _number(whole))
    for each in (each for each in grades if each.student and each.final is not None):
        assert each.student
        cells = each.student.cells
        own = [cells.get(name.lower(), "") for name in CANVAS[1:]]
        yield (each.student.name, *own, _scaled(each, whole))


def _moodle(grades: Sequence[StudentGrade], whole: float) -> Iterable[Line]:
    yield MOODLE
    for each in (each for each in grades if each.student):
        assert each.student
        who = (_identifier(each), each.student.name, each.student.email)
        yield (*who, _scaled(each, whole), _comment(each))


def _identifier(grade: StudentGrade) -> str:
    """What Moodle calls the student in its worksheet; else their number."""
    student = grade.student
    return student.cells.get(IDENTIFIER, student.id).strip() if student else ""


def _mark(grade: StudentGrade) -> Mark | None:
    """What goes into the worksheet; None where a line stays as it is."""
    if grade.student is None or grade.outcome == "missing":
        return None
    if grade.final is None and grade.outcome != "refused":
        return None  # nobody could tell, and why is not the student's
    return Mark(grade.final, _safe(_comment(grade)))


def _comment(grade: StudentGrade) -> str:
    """What to mend first, in a line; the whole of it is on the student's page."""
    if grade.override or not grade.result:
        return _reason(grade)
    if not grade.result.verdict:
        return _whole_reason(*grade.result.told_to_student)
    shown = shown_checks(grade.result.verdict)
    failed = [check.title for check in shown if check.outcome == "fail"]
    to_mend = f"To mend: {'; '.join(failed)}" if failed else ""
    return " ".join(filter(None, (grade.late_words, to_mend)))


def _scaled(grade: StudentGrade, whole: float) -> str:
    """The score in the platform's points."""
    return "" if grade.final is None else _number(round(grade.final * whole / WHOLE, 2))


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:g}"
