"""A verdict as one grader of GitHub Classroom's workflow hands it to the reporter.

Source of the fields: classroom-resources/autograding-grading-reporter, which reads `status`,
`max_score` and `tests` with `name`, `status`, `score` and `message`. It reports no points where
`max_score` is 0: so a verdict that could not be reached is no zero there.
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
from roslings.report.whole_file import write_whole
from roslings.verdict import CheckResult, Verdict

VERSION = 1
STATUS = {"pass": "pass", "fail": "fail", "skip": "fail", "inconclusive": "error"}
WHOLE = 100


def write_classroom(told: Verdict | Refusal, path: Path) -> None:
    """Write a verdict, or why there is none, to `path`. Raises CannotWriteFile."""
    table = refused(told) if isinstance(told, Refusal) else classroom_of(told)
    write_whole(path, f"{json.dumps(table, indent=2, ensure_ascii=True)}\n".encode())


def classroom_of(verdict: Verdict) -> dict[str, Any]:
    """The file as a table."""
    checks = shown_checks(verdict)
    known = verdict.score is not None
    tests = [_test(check, known) for check in checks]
    if not known:
        tests = [
            {
                "name": "verdict",
                "status": "error",
                "score": 0,
                "max_score": 0,
                "message": str(INCONCLUSIVE),
            },
            *tests,
        ]
    most = sum(check.max_points for check in checks) if known else 0
    return {
        "version": VERSION,
        "status": STATUS[verdict.outcome],
        "max_score": most,
        "tests": tests,
    }


def refused(refusal: Refusal) -> dict[str, Any]:
    """The file where there is no verdict."""
    counts = refusal.is_students
    most = WHOLE if counts else 0
    test = {
        "name": "submission",
        "status": "fail" if counts else "error",
        "score": 0,
        "max_score": most,
        "message": refusal.text if counts else f"{NO_GRADE}\n{refusal.text}",
    }
    return {"version": VERSION, "status": test["status"], "max_score": most, "tests": [test]}


def _test(check: CheckResult, known: bool) -> dict[str, Any]:
    return {
        "name": harmless(check.title),
        "status": STATUS[check.outcome],
        "score": check.points if known else 0,
        "max_score": check.max_points if known else 0,
        "message": harmless("\n".join(lines_of(check)[1:]), keep_newlines=True),
    }
