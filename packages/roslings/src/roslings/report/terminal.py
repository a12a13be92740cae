"""The verdict as a student sees it in the terminal: what passes, what fails, what to do next."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Sequence

from rich.console import Console

from ros2_on_pip.errors import RoslingsError
from ros2_on_pip.language import Text, counted, said
from roslings.report.check_lines import (
    INDENT,
    WORDS,
    points_of,
    put_details,
    put_heading,
    put_line,
    put_title,
    put_together,
)
from roslings.report.command_line import CommandLine
from roslings.report.groups import by_reason, of_outcome
from roslings.report.hint_page import first_failed, hint_command, put_hint
from roslings.report.often_said import (
    ASK_FOR_A_HINT,
    CHECK_AGAIN,
    GO_ON,
    MAKE_THE_FILE,
    NEXT,
    REMARKS,
    SEE_ALL_CHECKS,
    STUCK,
    WHY,
    mend_first,
)
from roslings.report.page import Page
from roslings.report.screen_page import put_screen
from roslings.verdict import CheckOutcome, CheckResult, Verdict

UNSOAKED = Text(
    "verdict.unsoaked", "Your nodes ran for some seconds here. `pack` lets them run for longer."
)
NOT_JUDGED: tuple[CheckOutcome, ...] = ("skip", "inconclusive")


class NoSuchCheck(RoslingsError):
    """The verdict has no check of the name that was asked for."""

    def __init__(self, verdict: Verdict, name: str) -> None:
        names = [check.id for check in verdict.checks]
        near = difflib.get_close_matches(name, names, n=1)
        super().__init__(
            said(
                "verdict.no_such_check",
                "There is no check {name!r}.{guess} The checks are: {checks}.",
                name=name,
                guess=said("verdict.did_you_mean", " Did you mean {name!r}?", name=near[0])
                if near
                else "",
                checks=", ".join(names),
            )
        )


def print_verdict(
    verdict: Verdict,
    *,
    console: Console,
    hint_step: int | None = None,
    only: str | None = None,
    whole: bool = False,
    before: Verdict | None = None,
    command_line: CommandLine | None = None,
) -> None:
    """Show `verdict` on `console`; with `hint_step` (1 to 3) a hint and not the whole verdict.

    A screen gets the first failed check whole and the others folded, unless `whole` is asked for,
    and what has changed since `before`. `only` names the one check that is shown, or that the hint
    is for; without it a hint is for the first check that failed. `command_line` is how the verdict
    was asked for. Raises NoSuchCheck, and ValueError for another `hint_step`.
    """
    command_line = command_line or CommandLine(verdict.lab)
    check = None if only is None else _named(verdict, only)
    if hint_step is not None:
        page = Page(console, command_line)
        put_hint(page, verdict, check or first_failed(verdict), hint_step)
    elif check is not None:
        page = _page_of_one(verdict, Page(console, command_line), check)
    elif console.is_terminal and not whole and (first := first_failed(verdict)):
        page = _page_of_first(verdict, Page(console, command_line), first, before)
    else:
        page = _page_of_all(verdict, console, command_line)
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
        page.command(STUCK, ASK_FOR_A_HINT, hint_command(page.command_line, verdict, check, 1))
    page.command(NEXT, SEE_ALL_CHECKS, page.command_line.check())
    return page


def _page_of_first(
    verdict: Verdict, page: Page, first: CheckResult, before: Verdict | None
) -> Page:
    put_screen(page, verdict, first, before)
    _put_end(page, verdict)
    page.command(
        said("verdict.all", "All"),
        said("verdict.see_whole", "See every check whole:"),
        page.command_line.check("--all"),
    )
    return page


def _page_of_all(verdict: Verdict, console: Console, command_line: CommandLine) -> Page:
    """A line for each check; on a screen too low for that, what is not wrong shares lines."""
    page = _filled(Page(console, command_line), verdict, _each_on_a_line)
    if console.is_terminal and page.height() >= console.height:
        page = _filled(Page(console, command_line), verdict, _on_shared_lines)
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
        page.labelled(WHY, reason, indent=INDENT)


def _each_on_a_line(page: Page, checks: Sequence[CheckResult], points_width: int) -> None:
    for check in checks:
        put_line(page, check, points_width)


def _on_shared_lines(page: Page, checks: Sequence[CheckResult], points_width: int) -> None:
    if checks:
        put_together(page, checks)


def _put_advice(page: Page, verdict: Verdict) -> None:
    if verdict.advice:
        page.blank()
        page.line(REMARKS, "bold")
    for remark in verdict.advice:
        page.headed("- ", remark, style="")


def _put_score(page: Page, verdict: Verdict) -> None:
    score = (
        said("verdict.score.none", "none yet.")
        if verdict.score is None
        else said("verdict.score.given", "{score:g} of 100.", score=verdict.score)
    )
    page.labelled(said("verdict.score", "Score"), f"{score} {_count(verdict)}", style="bold")


def _count(verdict: Verdict) -> str:
    count = len(verdict.checks)
    if verdict.outcome == "pass":
        return counted(
            "verdict.count.all_pass",
            count,
            one="{count} check, and every one passes.",
            other="{count} checks, and every one passes.",
        )
    parts = ", ".join(each for outcome in WORDS if (each := _part(verdict, outcome)))
    return counted(
        "verdict.count",
        count,
        one="{count} check: {parts}.",
        other="{count} checks: {parts}.",
        parts=parts,
    )


def _part(verdict: Verdict, outcome: CheckOutcome) -> str:
    """How many checks ended so; empty for none."""
    count = len(of_outcome(verdict, outcome))
    if not count:
        return ""
    if outcome == "pass":
        return counted("verdict.passes", count, one="{count} passes", other="{count} pass")
    if outcome == "fail":
        return counted("verdict.fails", count, one="{count} fails", other="{count} fail")
    if outcome == "skip":
        return counted(
            "verdict.skipped", count, one="{count} is skipped", other="{count} are skipped"
        )
    return counted("verdict.open", count, one="{count} is open", other="{count} are open")


def _put_next(page: Page, verdict: Verdict) -> None:
    first = first_failed(verdict)
    if verdict.outcome == "pass":
        _put_praise(page, verdict)
    elif first is not None:
        _put_mend(page, verdict, first)
    else:
        _put_look_again(page, verdict)


def _put_praise(page: Page, verdict: Verdict) -> None:
    well_done = "Well done: {package} does all that this lab asks for."
    page.labelled("", said("verdict.well_done", well_done, package=verdict.package))
    if not page.command_line.handed_in:
        page.command(NEXT, GO_ON, page.command_line.program)
        return
    if not verdict.soak_s:
        page.labelled("", UNSOAKED)
    page.command(NEXT, MAKE_THE_FILE, page.command_line.pack)
    then = said("verdict.then_go_on", "Then go on with the course:")
    page.command("", then, page.command_line.program)


def _put_mend(page: Page, verdict: Verdict, first: CheckResult) -> None:
    page.command(NEXT, mend_first(verdict, first.id), page.command_line.check())
    if first.hints:
        page.command(STUCK, ASK_FOR_A_HINT, hint_command(page.command_line, verdict, first, 1))


def _put_look_again(page: Page, verdict: Verdict) -> None:
    if verdict.outcome == "inconclusive":
        not_told = "Not everything could be told. This costs you nothing."
        page.labelled("", said("verdict.not_told", not_told))
    page.command(NEXT, CHECK_AGAIN, page.command_line.check())
    stays = said("verdict.stays_so", "If it stays so, look at the machine:")
    page.command("", stays, f"{page.command_line.program} doctor")
