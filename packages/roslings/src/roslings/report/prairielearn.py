"""A verdict as PrairieLearn's external grader reads it from /grade/results/results.json.

Source of the fields: PrairieLearn's documentation, "External Grading", section "Grading results".
A grade is a part of one; without a grade the file says that nothing could be graded, and the
student loses no attempt.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from ros2_on_pip.safe_text import harmless
from roslings.report.junit import lines_of
from roslings.report.not_graded import INCONCLUSIVE, NO_GRADE
from roslings.report.refusal import Refusal
from roslings.report.shown_checks import shown_checks
from roslings.report.wall_words import held
from roslings.report.whole_file import write_whole
from roslings.verdict import CheckResult, Verdict


def write_prairielearn(told: Verdict | Refusal, path: Path) -> None:
    """Write a verdict, or why there is none, to `path`. Raises CannotWriteFile."""
    table = refused(told) if isinstance(told, Refusal) else prairielearn_of(told)
    write_whole(path, f"{json.dumps(table, indent=2, ensure_ascii=True)}\n".encode())


def prairielearn_of(verdict: Verdict) -> dict[str, Any]:
    """The file as a table."""
    if verdict.score is None:
        return {**_no_grade(str(INCONCLUSIVE)), "tests": [_test(c) for c in shown_checks(verdict)]}
    return {
        "gradable": True,
        "score": verdict.score / 100,
        "message": "\n".join(harmless(line) for line in (*verdict.advice, held(verdict)) if line),
        "tests": [_test(check) for check in shown_checks(verdict)],
    }


def refused(refusal: Refusal) -> dict[str, Any]:
    """The file where there is no verdict: a submission that can be mended costs no attempt."""
    words = refusal.text if refusal.is_students else f"{NO_GRADE}\n{refusal.text}"
    return _no_grade(words)


def _no_grade(words: str) -> dict[str, Any]:
    return {"gradable": False, "format_errors": [words], "message": words}


def _test(check: CheckResult) -> dict[str, Any]:
    return {
        "name": check.id,
        "description": harmless(check.title),
        "points": check.points,
        "max_points": check.max_points,
        "message": harmless(check.why or ""),
        "output": harmless("\n".join([*lines_of(check)[1:], *check.log]), keep_newlines=True),
    }
