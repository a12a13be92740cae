"""Judge the solution by a card with another word: first what was seen of it, then it anew.

This is the whole life of a process that `prove` starts, in place of an ordinary grading.
"""

from __future__ import annotations

import os
from pathlib import Path

from pydantic import BaseModel

from roslings import course
from roslings.judge import GraderBroke, judge
from roslings_class import grading
from roslings_class.result import GradingOrder, GradingResult, broken

ENTRY_POINT = f"{__name__}:main"
NOTE = "wanted.json"


class WantedVerdict(BaseModel):
    """What must come of the solution by the other card; it lies beside that card's course."""

    seen: Path
    """The packed evidence of the solution, measured by the card as it is."""
    must_fail: bool

    def is_met(self, result: GradingResult) -> bool:
        """Nothing else has to be tried."""
        if result.verdict is None:
            return False
        return result.verdict.outcome == ("fail" if self.must_fail else "pass")


def main(order: GradingOrder) -> None:
    """Answer from the evidence where that is enough; else grade."""
    assert order.course is not None
    os.environ["ROSLINGS_COURSE"] = str(order.course)
    wanted = WantedVerdict.model_validate_json((order.course / NOTE).read_text("utf-8"))
    result = judged(order, wanted)
    if wanted.is_met(result) or result.broken_by_grader:
        grading.put(result, order)
    else:
        grading.main(order)


def judged(order: GradingOrder, wanted: WantedVerdict) -> GradingResult:
    """What the other card makes of the same evidence; it may break the grader."""
    evidence = grading.unpacked(wanted.seen.read_bytes())
    try:
        verdict = judge(course.lab(order.lab), evidence)
    except GraderBroke as mistake:
        return broken(order, mistake.in_short, by_the_grader=True)
    return GradingResult(
        submission=order.submission,
        digest=order.digest,
        attempt=order.attempt,
        state="graded",
        verdict=verdict,
    )
