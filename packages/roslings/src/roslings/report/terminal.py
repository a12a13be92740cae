"""The verdict as a student sees it in the terminal: what passes, what fails, what to do next."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Sequence

from rich.console import Console

from ros2_on_pip.errors import RoslingsError
from roslings.report.check_lines import (
    INDENT,
    points_of,
    put_details,
    put_heading,
    put_line,
    put_title,
    put_together,
)
from roslings.report.groups import by_reason, of_outcome
from roslings.report.hint_page import first_failed, hint_command, put_hint
from roslings.report.page import Page
from roslings.report.screen_page import put_screen
from roslings.report.typed import Typed
from roslings.verdict import CheckOutcome, CheckResult, Verdict

UNSOAKED = "Your nodes ran for some seconds here. `pack` lets them run for longer."
NOT_JUDGED: tuple[CheckOutcome, ...] = ("skip", "inconclusive")


class NoSuchCheck(RoslingsError):
    """The verdict has no check of the name that was asked for."""

    def __init__(self, verdict: Verdict, name: str) -> None:
        names = [check.id for check in verdict.checks]
        near = difflib.get_close_matches(name, names, n=1)
        guess = f" Did you mean {near[0]!r}?" if near else ""
        super().__init__(f"There is no check {name!r}.{guess} The checks are: {', '.join(names)}.")


def print_verdict(
    verdict: Verdict,
    *,
    console: Console,
    hint_step: int | None = None,
    only: str | None = None,
    whole: bool = False,
    before: Verdict | None = None,
    typed: Typed | None = None,
) -> None:
    """Show `verdict` on `console`; with `hint_step` (1 to 3) a hint and not the whole verdict.

    A screen gets the first failed check whole and the others folded, unless `whole` is asked for,
    and what has changed since `before`.
    `only` names the one check that is shown, or that the hint is for; without it a hint is for
    the first check that failed. `typed` is how the verdict was asked for. Raises NoSuchCheck, and
    ValueError for another `hint_step`.
    """
    typed = typed or Typed(verdict.lab)
    check = None if only is None else _named(verdict, only)
    if hint_step is not None:
        page = Page(console, typed)
        put_hint(page, verdict, check or first_failed(verdict), hint_step)
    elif check is not None:
        page = _page_of_one(verdict, Page(console, typed), check)
    elif console.is_terminal and not whole and (first := first_failed(verdict)):
        page = _page_of_first(verdict, Page(console, typed), first, before)
    else:
        page = _page_of_all(verdict, console, typed)
    page.print()


def _named(verdict: Verdict, name: str) -> CheckResult:
    for check in verdict.checks:
        if check.id == name:
            return check
    raise NoSuchCheck(verdict, name)


def _page_of_one(verdict: Verdict, page: Page, check: CheckResult) -> Page:
    put_title(page, verdict)
    put_heading(page, check)
    put_details(page, check, verdict.package)
    page.blank()
    if check.outcome == "fail" and check.hints:
        page.command("Stuck", "Ask for a hint:", hint_command(page.typed, verdict, check, 1))
    page.command("Next", "See all checks:", page.typed.check())
    return page


def _page_of_first(
    verdict: Verdict, page: Page, first: CheckResult, before: Verdict | None
) -> Page:
    put_screen(page, verdict, first, before)
    _put_end(page, verdict)
    page.command("All", "See every check whole:", page.typed.check("--all"))
    return page


def _page_of_all(verdict: Verdict, console: Console, typed: Typed) -> Page:
    """A line for each check; on a screen too low for that, what is not wrong shares lines."""
    page = _filled(Page(console, typed), verdict, _each_on_a_line)
    if console.is_terminal and page.height() >= console.height:
        page = _filled(Page(console, typed), verdict, _on_shared_lines)
    return page


Put = Callable[[Page, Sequence[CheckResult], int], None]


def _filled(page: Page, verdict: Verdict, put: Put) -> Page:
    width = max((len(points_of(check)) for check in verdict.checks), default=0)
    put_title(page, verdict)
    put(page, of_outcome(verdict, "pass"), width)
    for outcome in NOT_JUDGED:
        _put_not_judged(page, of_outcome(verdict, outcome), width, put)
    for check in verdict.failed():
        page.blank()
        put_heading(page, check, width)
        put_details(page, check, verdict.package)
    _put_end(page, verdict)
    return page


def _put_end(page: Page, verdict: Verdict) -> None:
    _put_advice(page, verdict)
    page.blank()
    _put_score(page, verdict)
    _put_next(page, verdict)


def _put_not_judged(page: Page, checks: Sequence[CheckResult], width: int, put: Put) -> None:
    if checks:
        page.blank()
    for reason, group in by_reason(checks):
        put(page, group, width)
        page.labelled("why", reason, indent=INDENT)


def _each_on_a_line(page: Page, checks: Sequence[CheckResult], points_width: int) -> None:
    for check in checks:
        put_line(page, check, points_width)


def _on_shared_lines(page: Page, checks: Sequence[CheckResult], points_width: int) -> None:
    if checks:
        put_together(page, checks)


def _put_advice(page: Page, verdict: Verdict) -> None:
    if verdict.advice:
        page.blank()
        page.line("Remarks that cost no points", "bold")
    for remark in verdict.advice:
        page.headed("- ", remark, style="")


def _put_score(page: Page, verdict: Verdict) -> None:
    score = "none yet." if verdict.score is None else f"{verdict.score:g} of 100."
    page.labelled("Score", f"{score} {_count(verdict)}", style="bold")


def _count(verdict: Verdict) -> str:
    total = _counted(len(verdict.checks), "check", "checks")
    if verdict.outcome == "pass":
        return f"{total}, and every one passes."
    parts = [
        _counted(len(of_outcome(verdict, "pass")), "passes", "pass"),
        _counted(len(of_outcome(verdict, "fail")), "fails", "fail"),
        _counted(len(of_outcome(verdict, "skip")), "is skipped", "are skipped"),
        _counted(len(of_outcome(verdict, "inconclusive")), "is open", "are open"),
    ]
    return f"{total}: {', '.join(part for part in parts if not part.startswith('0'))}."


def _counted(count: int, one: str, many: str) -> str:
    return f"{count} {one if count == 1 else many}"


def _put_next(page: Page, verdict: Verdict) -> None:
    first = first_failed(verdict)
    if verdict.outcome == "pass":
        _put_praise(page, verdict)
    elif first is not None:
        _put_mend(page, verdict, first)
    else:
        _put_look_again(page, verdict)


def _put_praise(page: Page, verdict: Verdict) -> None:
    page.labelled("", f"Well done: {verdict.package} does all that this lab asks for.")
    if not page.typed.handed_in:
        page.command("Next", "Go on with the course:", page.typed.program)
        return
    if not verdict.soak_s:
        page.labelled("", UNSOAKED)
    page.command("Next", "Make the file to hand in:", page.typed.pack)
    page.command("", "Then go on with the course:", page.typed.program)


def _put_mend(page: Page, verdict: Verdict, first: CheckResult) -> None:
    order = " first" if len(verdict.failed()) > 1 else ""
    page.command("Next", f'Mend "{first.id}"{order}, then check again:', page.typed.check())
    if first.hints:
        page.command("Stuck", "Ask for a hint:", hint_command(page.typed, verdict, first, 1))


def _put_look_again(page: Page, verdict: Verdict) -> None:
    if verdict.outcome == "inconclusive":
        page.labelled("", "Not everything could be told. This costs you nothing.")
    page.command("Next", "Check again:", page.typed.check())
    page.command("", "If it stays so, look at the machine:", f"{page.typed.program} doctor")
