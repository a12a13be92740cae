"""A verdict in the shape of check50's JSON, for tools that read that."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from roslings.report.junit import lines_of
from roslings.report.safe_text import harmless
from roslings.report.whole_file import write_whole
from roslings.verdict import CheckResult, Verdict

PASSED = {"pass": True, "fail": False}
"""A check that was skipped, or that nobody could judge, is neither."""


def write_check50(verdict: Verdict, path: Path) -> None:
    """Write `verdict` to `path`. Raises CannotWrite."""
    text = json.dumps(check50_of(verdict), indent=2, ensure_ascii=True)
    write_whole(path, f"{text}\n".encode())


def check50_of(verdict: Verdict) -> dict[str, Any]:
    """The file as a table."""
    return {
        "slug": f"roslings/{verdict.lab}",
        "version": verdict.environment.roslings,
        "results": [_result(check) for check in verdict.checks],
    }


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
