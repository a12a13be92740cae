"""A hint for one check, in three steps; never more at once than was asked for."""

from __future__ import annotations

from ros2_on_pip.language import Text, said
from roslings.report.check_lines import INDENT, put_heading, put_title
from roslings.report.command_line import CommandLine
from roslings.report.often_said import MEASURED, MEND, NEXT, SEE_ALL_CHECKS, WHY
from roslings.report.page import Page
from roslings.verdict import CheckResult, Verdict

STEPS = (
    Text("hint.where", "where to look"),
    Text("hint.idea", "which idea"),
    Text("hint.other_code", "the same idea in other code"),
)


def first_failed(verdict: Verdict) -> CheckResult | None:
    """The check to mend first; None where none failed."""
    return next(iter(verdict.failed()), None)


def hint_command(command_line: CommandLine, verdict: Verdict, check: CheckResult, step: int) -> str:
    """What the student types for step `step` (1 to 3) of the hint for `check`."""
    only = () if check == first_failed(verdict) else ("--only", check.id)
    number = () if step == 1 else (str(step),)
    return command_line.check(*only, "--hint", *number)


def put_hint(page: Page, verdict: Verdict, check: CheckResult | None, step: int) -> None:
    """Step `step` (1 to 3) of the hint for `check`. Raises ValueError for any other step."""
    if not 1 <= step <= len(STEPS):
        raise ValueError(f"A hint has the steps 1 to {len(STEPS)}; there is no step {step}.")
    put_title(page, verdict)
    if check is None:
        _put_none_failed(page)
        return
    put_heading(page, check)
    if check.outcome == "fail":
        _put_step(page, verdict, check, step)
    else:
        _put_no_hint(page, verdict, check)


def _put_step(page: Page, verdict: Verdict, check: CheckResult, step: int) -> None:
    if check.measured:
        page.labelled(MEASURED, check.measured, indent=INDENT)
    page.blank()
    if step > len(check.hints):
        page.line(said("hint.no_such", "This check has no such hint."))
    else:
        title = said(
            "hint.title",
            "Hint {number} of {count}: {step}",
            number=step,
            count=len(check.hints),
            step=STEPS[step - 1],
        )
        page.line(title, "bold")
        page.text(page.command_line.told(check.hints[step - 1]), indent=INDENT)
    if check.mend and step >= len(check.hints):
        page.labelled(MEND, page.command_line.told(check.mend), indent=INDENT)
    page.blank()
    _put_after(page, verdict, check, step)


def _put_after(page: Page, verdict: Verdict, check: CheckResult, step: int) -> None:
    if check.lesson:
        page.lesson(said("hint.read", "Read"), check.lesson)
    if step < len(check.hints):
        page.command(
            said("hint.more", "More"),
            said("hint.next", "The next hint:"),
            hint_command(page.command_line, verdict, check, step + 1),
        )
    page.command(
        NEXT, said("hint.mend_it", "Mend it, then check again:"), page.command_line.check()
    )


def _put_none_failed(page: Page) -> None:
    none_failed = "No check failed, so there is nothing to give a hint for."
    page.line(said("hint.none_failed", none_failed))
    page.command(NEXT, SEE_ALL_CHECKS, page.command_line.check())


def _put_no_hint(page: Page, verdict: Verdict, check: CheckResult) -> None:
    if check.why:
        page.labelled(WHY, check.why, indent=INDENT)
    first = first_failed(verdict)
    page.blank()
    if first is None:
        page.line(said("hint.not_needed", "This check did not fail, so it needs no hint."))
        page.command(NEXT, SEE_ALL_CHECKS, page.command_line.check())
    else:
        did_not_fail = "This check did not fail. Hints are for checks that failed."
        page.line(said("hint.did_not_fail", did_not_fail))
        hint = said("hint.for", "A hint for {check}:", check=first.id)
        page.command(NEXT, hint, hint_command(page.command_line, verdict, first, 1))
