"""A verdict as Gradescope's autograder reads it from results/results.json.

Source of the fields: Gradescope's autograder documentation, "Autograder Specifications".
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from ros2_on_pip.safe_text import harmless
from roslings.report.markdown import markdown_of
from roslings.report.not_graded import INCONCLUSIVE, NO_GRADE
from roslings.report.refusal import Refusal
from roslings.report.wall_words import held
from roslings.report.whole_file import write_whole
from roslings.verdict import CheckResult, Verdict

STATUS = {"pass": "passed", "fail": "failed"}


def write_gradescope(told: Verdict | Refusal, path: Path) -> None:
    """Write a verdict, or why there is none, to `path`. Raises CannotWriteFile."""
    table = refused(told) if isinstance(told, Refusal) else gradescope_of(told)
    text = json.dumps(table, indent=2, ensure_ascii=True)
    write_whole(path, f"{text}\n".encode())


def gradescope_of(verdict: Verdict) -> dict[str, Any]:
    """The file as a table.

    An inconclusive verdict has no score at all: Gradescope then calls the run failed, and puts
    no zero into its gradebook.
    """
    remarks = [*verdict.advice, *filter(None, [held(verdict)])]
    output = "\n".join(harmless(remark) for remark in remarks)
    if verdict.outcome == "inconclusive":
        output = f"{INCONCLUSIVE}\n{output}".rstrip()
    known = verdict.outcome != "inconclusive"
    return {
        **({"score": verdict.score} if known else {}),
        "output": output,
        "output_format": "text",
        "execution_time": round(verdict.seconds.total),
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": [_test(check, known) for check in verdict.checks],
        "extra_data": {
            "lab": verdict.lab,
            "outcome": verdict.outcome,
            "wall": verdict.environment.wall,
        },
    }


def refused(refusal: Refusal) -> dict[str, Any]:
    """The file where there is no verdict.

    A run without any score is shown to instructors only: what a student can mend is a zero, with
    the words beside it.
    """
    counts = refusal.is_students
    return {
        **({"score": 0.0} if counts else {}),
        "output": refusal.text if counts else f"{NO_GRADE}\n{refusal.text}",
        "output_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": [],
        "extra_data": {"lab": refusal.lab, "outcome": "refused" if counts else "inconclusive"},
    }


def _test(check: CheckResult, known: bool) -> dict[str, Any]:
    points = {"score": check.points, "max_score": check.max_points} if known else {}
    words: dict[str, Any] = {
        "name": harmless(check.title),
        "number": check.id,
        **points,
        "output_format": "md",
        "visibility": "hidden" if check.hidden else "visible",
        "output": markdown_of(check),
    }
    if check.outcome in STATUS:
        words["status"] = STATUS[check.outcome]
    return words
