"""How one check stands on a page: its mark, word and points, and what there is to say of it."""

from __future__ import annotations

from collections.abc import Sequence

from ros2_on_pip.language import Text, said
from roslings.report.log_lines import helpful
from roslings.report.often_said import EXPECTED, MEASURED, READ, TRY, WHY
from roslings.report.page import Page
from roslings.verdict import CheckOutcome, CheckResult, Verdict

WORDS: dict[CheckOutcome, Text] = {
    "pass": Text("verdict.mark.pass", "pass"),
    "fail": Text("verdict.mark.fail", "fail"),
    "skip": Text("verdict.mark.skip", "skip"),
    "inconclusive": Text("verdict.mark.open", "open"),
}
STYLES: dict[CheckOutcome, str] = {
    "pass": "green",
    "fail": "bold red",
    "skip": "bold",
    "inconclusive": "bold magenta",
}
LOG_LINES = 8
INDENT = 2


def put_title(page: Page, verdict: Verdict) -> None:
    """What was checked, and how long that took."""
    title = said(
        "verdict.title", "Lab {lab}, package {package}", lab=verdict.lab, package=verdict.package
    )
    seconds = f", {verdict.seconds.total:.1f} s" if verdict.seconds.total else ""
    page.line(title + seconds, "bold")


def points_of(check: CheckResult) -> str:
    """Points given and possible, e.g. `3/15`; `?/15` where nobody could look."""
    given = "?" if check.outcome == "inconclusive" else f"{check.points:g}"
    return f"{given}/{check.max_points:g}"


def put_line(page: Page, check: CheckResult, points_width: int = 0) -> None:
    """One check on one line; its end is cut off where the line is too short."""
    text = _title(check)
    if check.outcome == "pass" and check.measured:
        text = f"{text.removesuffix('.')} ({check.measured})"
    page.headed_line(_head(page, check, points_width), text, style=STYLES[check.outcome])


def put_heading(page: Page, check: CheckResult, points_width: int = 0) -> None:
    """One check with its name and its whole title."""
    head = _head(page, check, points_width)
    text = f"{check.id}: {_title(check)}"
    page.headed(head, text, style=STYLES[check.outcome], text_style="bold")


def put_together(page: Page, checks: Sequence[CheckResult]) -> None:
    """Checks of one outcome by name and points, many on a line."""
    outcome = checks[0].outcome
    items = [f"{check.id} {points_of(check)}" for check in checks]
    page.headed_items(_start(page, outcome) + "  ", items, style=STYLES[outcome])


def put_details(page: Page, check: CheckResult, package: str) -> None:
    """All that a verdict says of one check, each part with its label."""
    parts = {
        EXPECTED: check.expected,
        MEASURED: check.measured,
        WHY: check.why,
        TRY: check.hint,
    }
    for label, text in parts.items():
        if text:
            page.labelled(label, page.command_line.told(text), indent=INDENT)
    if check.lesson:
        page.lesson(READ, check.lesson, indent=INDENT)
    _put_log(page, check.log, package)


def _start(page: Page, outcome: CheckOutcome) -> str:
    return f"{page.marks[outcome]} {WORDS[outcome]}"


def _head(page: Page, check: CheckResult, points_width: int) -> str:
    return f"{_start(page, check.outcome)}  {points_of(check):>{points_width}}  "


def _title(check: CheckResult) -> str:
    return " ".join(check.title.split())


def _put_log(page: Page, log: Sequence[str], package: str) -> None:
    lines = helpful(log, package, LOG_LINES)
    if lines:
        page.boxed(said("verdict.last_lines", "The last lines that came out"), lines, indent=INDENT)
