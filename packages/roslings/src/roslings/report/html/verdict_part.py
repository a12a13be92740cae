"""The verdict on the page: the score, what to mend with its hints, what is right."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from ros2_on_pip.language import Text, counted, said
from ros2_on_pip.markup import Markup, joined, prose, tag, told
from roslings.report.check_lines import LOG_LINES, points_of
from roslings.report.command_line import CommandLine
from roslings.report.groups import by_reason, of_outcome
from roslings.report.hint_page import STEPS, first_failed
from roslings.report.html.slips import marked
from roslings.report.log_lines import helpful
from roslings.report.often_said import (
    CHECK_AGAIN,
    EXPECTED,
    GO_ON,
    MAKE_THE_FILE,
    MEASURED,
    NEXT,
    READ,
    REMARKS,
    TRY,
    WHY,
    mend_first,
)
from roslings.verdict import CheckOutcome, CheckResult, Outcome, Verdict

HEADLINES: dict[Outcome, Text] = {
    "pass": Text("page.headline.pass", "Every check passes"),
    "fail": Text("page.headline.fail", "Not yet"),
    "inconclusive": Text("page.headline.open", "No verdict yet: not everything could be told"),
}
WORDS: dict[CheckOutcome, Text] = {
    "pass": Text("page.word.pass", "pass"),
    "fail": Text("page.word.fail", "fail"),
    "skip": Text("page.word.skip", "skipped"),
    "inconclusive": Text("page.word.open", "open"),
}
NO_SCORE = Text("page.no_score", "no score")
LESSON = re.compile(r"(days/(\d+)[\w-]*)#([\w-]+)")
MARKS: dict[CheckOutcome, str] = {"pass": "✓", "fail": "✗", "skip": "-", "inconclusive": "?"}


def head(verdict: Verdict, command_line: CommandLine, whose: str = "", counts: str = "") -> Markup:
    """What was checked, of whom, what came of it, and what counts besides."""
    of_whom = [tag("b", whose), " · "] if whose else []
    return tag(
        "header",
        tag("p", *of_whom, _what(verdict), class_="over"),
        tag("h1", str(HEADLINES[verdict.outcome])),
        _score(verdict),
        *([tag("p", tag("b", counts))] if counts else []),
        _counts(verdict),
        _next(verdict, command_line),
        class_=verdict.outcome,
    )


def _what(verdict: Verdict) -> str:
    return said(
        "page.what", "Lab {lab} · package {package}", lab=verdict.lab, package=verdict.package
    )


def _next(verdict: Verdict, command_line: CommandLine) -> Markup:
    """One thing to do now, in the words of the terminal."""
    first = first_failed(verdict)
    if verdict.outcome == "pass" and not command_line.handed_in:
        words, command = str(GO_ON), command_line.program
    elif verdict.outcome == "pass":
        words, command = str(MAKE_THE_FILE), command_line.pack
    elif first:
        words, command = mend_first(verdict, first.id), command_line.check()
    else:
        words, command = str(CHECK_AGAIN), command_line.check()
    return tag("p", tag("b", str(NEXT)), f" {words} ", tag("code", command), class_="next")


def _score(verdict: Verdict) -> Markup:
    if verdict.score is None:
        return tag("p", str(NO_SCORE), class_="score")
    bar = tag(
        "svg",
        tag("rect", x=0.0, y=0.0, width=100.0, height=4.0, class_="bar"),
        tag("rect", x=0.0, y=0.0, width=verdict.score, height=4.0, class_="filled"),
        viewBox="0 0 100 4",
        preserveAspectRatio="none",
        aria_hidden="true",
        class_="meter",
    )
    points = tag("b", f"{verdict.score:g}")
    return joined(
        tag("p", told("page.score", "{points} of 100", points=points), class_="score"), bar
    )


def _counts(verdict: Verdict) -> Markup:
    counts = [
        tag("li", f"{MARKS[outcome]} {len(some)} {word}", class_=outcome)
        for outcome, word in WORDS.items()
        if (some := of_outcome(verdict, outcome))
    ]
    return tag("ul", *counts, class_="counts")


def body(
    verdict: Verdict, plots: Mapping[str, Markup], site: str = "", program: str = "./roslings"
) -> Iterator[Markup]:
    """The checks: those to mend first, each whole; then the others, folded.

    `plots` are the figures that show what a check found wrong, by the check's id. `site` is the
    address of the lessons' pages, and `program` how roslings is called.
    """
    failed = [
        _failed(check, verdict.package, plots.get(check.id, Markup()), _read(check, site, program))
        for check in verdict.failed()
    ]
    if failed:
        yield tag("section", tag("h2", said("page.to_mend", "What to mend")), *failed)
    if verdict.advice:
        remarks = [tag("li", prose(remark)) for remark in verdict.advice]
        heading = tag("h2", str(REMARKS))
        yield tag("section", heading, tag("ul", *remarks))
    others = [*_not_judged(verdict), *_passed(verdict, folded=bool(failed))]
    if others:
        title = (
            said("page.others", "All other checks") if failed else said("page.all", "The checks")
        )
        yield tag("section", tag("h2", title), *others)


def _not_judged(verdict: Verdict) -> Iterator[Markup]:
    """Those that wait for another one, its name said once."""
    for outcome in ("inconclusive", "skip"):
        for why, checks in by_reason(of_outcome(verdict, outcome)):
            count = _skipped(len(checks)) if outcome == "skip" else _open(len(checks))
            words = [MARKS[outcome], f" {count}: ", prose(why)]
            yield tag("details", tag("summary", *words, class_=outcome), _rows(checks))


def _skipped(count: int) -> str:
    return counted(
        "page.skipped", count, one="{count} check skipped", other="{count} checks skipped"
    )


def _open(count: int) -> str:
    return counted("page.open", count, one="{count} check open", other="{count} checks open")


def _passed(verdict: Verdict, folded: bool) -> Iterator[Markup]:
    checks = of_outcome(verdict, "pass")
    if checks and folded:
        count = counted(
            "page.pass", len(checks), one="{count} check passes", other="{count} checks pass"
        )
        words = tag("summary", f"{MARKS['pass']} {count}", class_="pass")
        yield tag("details", words, _rows(checks))
    elif checks:
        yield _rows(checks)


def _rows(checks: Sequence[CheckResult]) -> Markup:
    return tag("ul", *map(_row, checks), class_="checks")


def _read(check: CheckResult, site: str, program: str) -> Markup:
    """Which paragraph of a lesson to read: a link, or how the lesson is opened."""
    lesson = check.lesson or ""
    found = LESSON.fullmatch(lesson)
    if not found:
        return prose(lesson)
    if site:
        return tag("a", lesson, href=f"{site}/{found[1]}/index.html#{found[3]}")
    command = tag("code", f"{program} lab {int(found[2])}")
    opens = "{lesson}, in the lesson that {command} opens"
    return told("page.read_in", opens, lesson=lesson, command=command)


def _failed(check: CheckResult, package: str, plot: Markup, read: Markup) -> Markup:
    expected, measured = check.expected or "", check.measured or ""
    seen = {EXPECTED: marked(expected, measured), MEASURED: marked(measured, expected)}
    rows = {WHY: prose(check.why or ""), TRY: prose(check.hint or ""), READ: read}
    return tag(
        "article",
        tag("h3", _mark("fail"), " ", prose(check.title)),
        tag(
            "p", told("page.points", "{check} · {points} points", **_points(check)), class_="about"
        ),
        tag(
            "dl",
            *(_row_of(label, tag("strong", text)) for label, text in seen.items() if text),
            *(_row_of(label, text) for label, text in rows.items() if text),
        ),
        plot,
        *_log(check, package),
        *_hints(check),
        id=f"check-{check.id}",
    )


def _points(check: CheckResult) -> dict[str, str]:
    return {"check": tag("code", check.id), "points": points_of(check)}


def _row_of(label: Text, text: Markup) -> Markup:
    return tag("div", tag("dt", str(label)), tag("dd", text))


def _log(check: CheckResult, package: str) -> Iterator[Markup]:
    lines = helpful(check.log, package, LOG_LINES)
    if lines:
        yield tag("p", said("page.last_lines", "The last lines that came out:"), class_="about")
        yield tag("pre", "\n".join(lines), tabindex="0")


def _hints(check: CheckResult) -> Iterator[Markup]:
    """Each step folded: who reads one does not see the next."""
    for number, (step, hint) in enumerate(zip(STEPS, check.hints, strict=False), start=1):
        title = said("page.hint", "Hint {number}: {step}", number=number, step=step)
        yield tag("details", tag("summary", title), tag("pre", hint, tabindex="0", class_="hint"))
    if check.mend:
        title = said("page.mend", "What mends it")
        yield tag("details", tag("summary", title), tag("p", prose(check.mend)))


def _row(check: CheckResult) -> Markup:
    return tag(
        "li",
        _mark(check.outcome),
        tag("span", prose(check.title), class_="title"),
        tag("span", points_of(check), class_="points"),
        class_=check.outcome,
    )


def _mark(outcome: CheckOutcome) -> Markup:
    return tag("span", MARKS[outcome], class_="mark", role="img", aria_label=str(WORDS[outcome]))
