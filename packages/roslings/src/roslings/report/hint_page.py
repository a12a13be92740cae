"""A hint for one check, in three steps; never more at once than was asked for."""

from __future__ import annotations

from roslings.report.check_lines import INDENT, put_heading, put_title
from roslings.report.page import Page
from roslings.report.typed import Typed
from roslings.verdict import CheckResult, Verdict

STEPS = ("where to look", "which idea", "the same idea in other code")


def first_failed(verdict: Verdict) -> CheckResult | None:
    """The check to mend first; None where none failed."""
    return next(iter(verdict.failed()), None)


def hint_command(typed: Typed, verdict: Verdict, check: CheckResult, step: int) -> str:
    """What the student types for step `step` (1 to 3) of the hint for `check`."""
    only = () if check == first_failed(verdict) else ("--only", check.id)
    number = () if step == 1 else (str(step),)
    return typed.check(*only, "--hint", *number)


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
        page.labelled("measured", check.measured, indent=INDENT)
    page.blank()
    if step > len(check.hints):
        page.line("This check has no such hint.")
    else:
        page.line(f"Hint {step} of {len(check.hints)}: {STEPS[step - 1]}", "bold")
        page.text(page.typed.told(check.hints[step - 1]), indent=INDENT)
    if check.mend and step >= len(check.hints):
        page.labelled("mend", page.typed.told(check.mend), indent=INDENT)
    page.blank()
    _put_after(page, verdict, check, step)


def _put_after(page: Page, verdict: Verdict, check: CheckResult, step: int) -> None:
    if check.lesson:
        page.lesson("Read", check.lesson)
    if step < len(check.hints):
        page.command("More", "The next hint:", hint_command(page.typed, verdict, check, step + 1))
    page.command("Next", "Mend it, then check again:", page.typed.check())


def _put_none_failed(page: Page) -> None:
    page.line("No check failed, so there is nothing to give a hint for.")
    page.command("Next", "See all checks:", page.typed.check())


def _put_no_hint(page: Page, verdict: Verdict, check: CheckResult) -> None:
    if check.why:
        page.labelled("why", check.why, indent=INDENT)
    first = first_failed(verdict)
    page.blank()
    if first is None:
        page.line("This check did not fail, so it needs no hint.")
        page.command("Next", "See all checks:", page.typed.check())
    else:
        page.line("This check did not fail. Hints are for checks that failed.")
        page.command("Next", f"A hint for {first.id}:", hint_command(page.typed, verdict, first, 1))
