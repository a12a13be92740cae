"""The checks as platforms that can hide none show them: hidden ones are one line together."""

from __future__ import annotations

from ros2_on_pip.language import Text
from roslings.verdict import CheckResult, Verdict

TOGETHER = Text("verdict.hidden", "Checks that you do not have, together.")


def shown_checks(verdict: Verdict) -> tuple[CheckResult, ...]:
    """The open checks, and one that stands for all hidden ones: their points, and no more."""
    open_ones = tuple(check for check in verdict.checks if not check.hidden)
    hidden = tuple(check for check in verdict.checks if check.hidden)
    return (*open_ones, _together(hidden)) if hidden else open_ones


def _together(hidden: tuple[CheckResult, ...]) -> CheckResult:
    outcomes = {check.outcome for check in hidden}
    return CheckResult(
        id="hidden",
        title=str(TOGETHER),
        outcome="inconclusive"
        if "inconclusive" in outcomes
        else "pass"
        if outcomes == {"pass"}
        else "fail",
        points=sum(check.points for check in hidden),
        max_points=sum(check.max_points for check in hidden),
    )
