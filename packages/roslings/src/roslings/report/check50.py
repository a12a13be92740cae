"""A verdict in the shape of check50's JSON, for tools that read that."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from ros2_on_pip.safe_text import harmless
from roslings import __version__
from roslings.report.junit import lines_of
from roslings.report.refusal import Refusal
from roslings.report.wall_words import held
from roslings.report.whole_file import write_whole
from roslings.verdict import CheckResult, Verdict

PASSED = {"pass": True, "fail": False}
"""A check that was skipped, or that nobody could judge, is neither."""


def write_check50(told: Verdict | Refusal, path: Path) -> None:
    """Write a verdict, or why there is none, to `path`. Raises CannotWriteFile."""
    table = refused(told) if isinstance(told, Refusal) else check50_of(told)
    text = json.dumps(table, indent=2, ensure_ascii=True)
    write_whole(path, f"{text}\n".encode())


def check50_of(verdict: Verdict) -> dict[str, Any]:
    """The file as a table."""
    return {
        "slug": f"roslings/{verdict.lab}",
        "version": verdict.environment.roslings,
        "environment": {"wall": verdict.environment.wall, "about": held(verdict)},
        "results": [_result(check) for check in verdict.checks if not check.hidden],
    }


def refused(refusal: Refusal) -> dict[str, Any]:
    """The file where there is no verdict: check50 names what kept it from running."""
    kind = "Refused" if refusal.is_students else "NotGraded"
    error = {
        "type": kind,
        "value": refusal.text,
        "traceback": [],
        "data": {},
        "actions": {"show_traceback": False, "message": refusal.text},
    }
    return {"slug": f"roslings/{refusal.lab}", "version": __version__, "error": error}


def _result(check: CheckResult) -> dict[str, Any]:
    return {
        "name": check.id,
        "description": harmless(check.title),
        "passed": PASSED.get(check.outcome),
        "log": [harmless(line) for line in check.log],
        "cause": _cause(check),
        "data": {"points": check.points, "max_points": check.max_points},
        "dependency": None,
    }


def _cause(check: CheckResult) -> dict[str, str] | None:
    if check.outcome == "pass":
        return None
    if check.outcome != "fail":
        return {"rationale": harmless(check.why or ""), "help": ""}
    return {
        "rationale": harmless("; ".join(lines_of(check)[1:3])),
        "help": harmless(check.hint or ""),
    }
