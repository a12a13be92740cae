"""The verdict on a student's screen: what has changed, the first thing to mend, the rest folded.

A file or a pipe gets the whole page, and so does `--all`.
"""

from __future__ import annotations

from ros2_on_pip.language import said
from roslings.report.check_lines import (
    INDENT,
    put_details,
    put_heading,
    put_line,
    put_title,
    put_together,
)
from roslings.report.groups import by_reason, of_outcome
from roslings.report.often_said import WHY
from roslings.report.page import Page
from roslings.verdict import CheckOutcome, CheckResult, Verdict

MOST_LINES = 4
"""Checks that fail besides have a line each, up to so many."""


def put_screen(
    page: Page, verdict: Verdict, first: CheckResult, before: Verdict | None = None
) -> None:
    """`first` whole, all other checks on as few lines as they need.

    `before` is the verdict of the check before this one.
    """
    put_title(page, verdict)
    if before is not None:
        put_change(page, before, verdict)
    page.blank()
    put_heading(page, first)
    put_details(page, first, verdict.package)
    page.blank()
    _put_others(page, [check for check in verdict.failed() if check is not first])
    _put_waiting(page, verdict, "skip")
    _put_waiting(page, verdict, "inconclusive")
    if passed := of_outcome(verdict, "pass"):
        put_together(page, passed)


def put_change(page: Page, before: Verdict, now: Verdict) -> None:
    """Which checks have turned green since then, and which are green no more."""
    was, is_now = _passed(before), _passed(now)
    if new := [check.id for check in now.checks if check.id in is_now - was]:
        green = said("verdict.green", "Green since your last check: {checks}.", checks=_named(new))
        page.labelled(said("verdict.new", "New"), green, style="green")
    if lost := [check.id for check in now.checks if check.id in was - is_now]:
        was_green = "Green before, and not now: {checks}."
        text = said("verdict.not_green", was_green, checks=_named(lost))
        page.labelled(said("verdict.lost", "Lost"), text, style="red")


def _named(checks: list[str]) -> str:
    return ", ".join(checks)


def _passed(verdict: Verdict) -> set[str]:
    return {check.id for check in of_outcome(verdict, "pass")}


def _put_others(page: Page, checks: list[CheckResult]) -> None:
    """What fails, too."""
    if len(checks) > MOST_LINES:
        put_together(page, checks)
        return
    for check in checks:
        put_line(page, check)


def _put_waiting(page: Page, verdict: Verdict, outcome: CheckOutcome) -> None:
    """By name, and what they wait for."""
    for reason, checks in by_reason(of_outcome(verdict, outcome)):
        put_together(page, checks)
        page.labelled(WHY, reason, indent=INDENT)
