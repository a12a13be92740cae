"""What a check raised, in the words of a verdict. Knows no pytest: that takes long to load."""

from __future__ import annotations

import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from roslings.evidence import UnreadablePart
from roslings.judge.faults import Fault, Inconclusive, NothingToJudge, Unmet
from roslings.judge.faults.plain import fields_of
from roslings.judge.faults.python_words import hint_for, mend_for
from roslings.judge.faults.reasons import GraderFailed, NewerPart
from roslings.judge.grader_mistakes import GraderBroke, GraderMistake, mistake_of
from roslings.judge.remarks import remarks


def words_for(
    error: BaseException | None, title: str, graders: Sequence[Path] = ()
) -> dict[str, Any]:
    """Outcome and sentences for what a check raised; for None, that it passed.

    A mistake in one of `graders` is told with its line.
    """
    if error is None:
        return {"outcome": "pass", "measured": remarks()}
    if isinstance(error, AssertionError):
        error = Unmet(title, _message(error) or Unmet.NO_MESSAGE)
    if isinstance(error, Fault):
        return {
            "outcome": "fail",
            "expected": error.expected,
            "measured": error.measured,
            "why": error.why,
            "hint": hint_for(error.log) or error.hint,
            "mend": (mend_for(error.log) if hint_for(error.log) else error.mend) or None,
            "fault": type(error).__name__,
            "fields": fields_of(error),
            "log": error.log,
        }
    if isinstance(error, NothingToJudge):
        return {"outcome": "skip", "why": str(error)}
    if isinstance(error, UnreadablePart):
        return {"outcome": "inconclusive", "why": str(NewerPart(error.name, error.version))}
    if isinstance(error, Inconclusive):
        return {"outcome": "inconclusive", "why": str(error)}
    log = tuple("".join(traceback.format_exception(error)).strip().splitlines()[-12:])
    if found := mistake_of(error, graders):
        return {**words_for_mistake(found), "log": log}
    return {"outcome": "inconclusive", "why": str(GraderFailed()), "log": log}


def words_for_mistake(mistake: GraderMistake) -> dict[str, Any]:
    """Outcome and sentences for a check that cannot tell, by a mistake of the grader."""
    return {
        "outcome": "inconclusive",
        "why": str(GraderFailed(mistake.in_short)),
        "fault": GraderBroke.__name__,
    }


def _message(error: AssertionError) -> str:
    """What the grader wrote behind its `assert`; pytest's own words on the values are no message.

    pytest writes them behind the message, or in its place.
    """
    lines = str(error).strip().splitlines()
    theirs = next((n for n, line in enumerate(lines) if line.startswith("assert ")), len(lines))
    return " ".join(line.strip() for line in lines[:theirs])
