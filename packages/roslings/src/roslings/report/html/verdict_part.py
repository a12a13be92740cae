"""The verdict on the page: the score, what to mend with its hints, what is right."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from ros2_on_pip.markup import Markup, joined, prose, tag
from roslings.report.check_lines import LOG_LINES, points_of
from roslings.report.groups import by_reason, of_outcome
from roslings.report.hint_page import STEPS, first_failed
from roslings.report.html.slips import marked
from roslings.report.log_lines import helpful
from roslings.report.typed import Typed
from roslings.verdict import CheckOutcome, CheckResult, Outcome, Verdict

HEADLINES: dict[Outcome, str] = {
    "pass": "Every check passes",
    "fail": "Not yet",
    "inconclusive": "No verdict yet: not everything could be told",
}
WORDS: dict[CheckOutcome, str] = {
    "pass": "pass",
    "fail": "fail",
    "skip": "skipped",
    "inconclusive": "open",
}
LESSON = re.compile(r"(days/(\d+)[\w-]*)#([\w-]+)")
MARKS: dict[CheckOutcome, str] = {"pass": "✓", "fail": "✗", "skip": "-", "inconclusive": "?"}


def head(verdict: Verdict, typed: Typed, whose: str = "", counts: str = "") -> Markup:
    """What was checked, of whom, what came of it, and what counts besides."""
    of_whom = [tag("b", whose), " · "] if whose else []
    return tag(
        "header",
        tag("p", *of_whom, f"Lab {verdict.lab} · package {verdict.package}", class_="over"),
        tag("h1", HEADLINES[verdict.outcome]),
        _score(verdict),
        *([tag("p", tag("b", counts))] if counts else []),
        _counts(verdict),
        _next(verdict, typed),
        class_=verdict.outcome,
    )


def _next(verdict: Verdict, typed: Typed) -> Markup:
    """One thing to do now, in the words of the terminal."""
    first = first_failed(verdict)
    if verdict.outcome == "pass" and not typed.handed_in:
        words, command = "Go on with the course:", typed.program
    elif verdict.outcome == "pass":
        words, command = "Make the file to hand in:", typed.pack
    elif first:
        order = " first" if len(verdict.failed()) > 1 else ""
        words, command = f'Mend "{first.id}"{order}, then check again:', typed.check()
    else:
        words, command = "Check again:", typed.check()
    return tag("p", tag("b", "Next"), f" {words} ", tag("code", command), class_="next")


def _score(verdict: Verdict) -> Markup:
    if verdict.score is None:
        return tag("p", "no score", class_="score")
    bar = tag(
        "svg",
        tag("rect", x=0.0, y=0.0, width=100.0, height=4.0, class_="bar"),
        tag("rect", x=0.0, y=0.0, width=verdict.score, height=4.0, class_="filled"),
        viewBox="0 0 100 4",
        preserveAspectRatio="none",
        aria_hidden="true",
        class_="meter",
    )
    return joined(tag("p", tag("b", f"{verdict.score:g}"), " of 100", class_="score"), bar)


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

    `plots` are the figures that show what a check found wrong, by the check's id; `site` is the
    address of the lessons' pages, and `program` how roslings is called.
    """
    failed = [
        _failed(check, verdict.package, plots.get(check.id, Markup()), _read(check, site, program))
        for check in verdict.failed()
    ]
    if failed:
        yield tag("section", tag("h2", "What to mend"), *failed)
    if verdict.advice:
        remarks = [tag("li", prose(remark)) for remark in verdict.advice]
        heading = tag("h2", "Remarks that cost no points")
        yield tag("section", heading, tag("ul", *remarks))
    others = [*_not_judged(verdict), *_passed(verdict, folded=bool(failed))]
    if others:
        heading = tag("h2", "All other checks" if failed else "The checks")
        yield tag("section", heading, *others)


def _not_judged(verdict: Verdict) -> Iterator[Markup]:
    """Those that wait for another one, its name said once."""
    for outcome in ("inconclusive", "skip"):
        for why, checks in by_reason(of_outcome(verdict, outcome)):
            count = "1 check" if len(checks) == 1 else f"{len(checks)} checks"
            words = [MARKS[outcome], f" {count} {WORDS[outcome]}: ", prose(why)]
            yield tag("details", tag("summary", *words, class_=outcome), _rows(checks))


def _passed(verdict: Verdict, folded: bool) -> Iterator[Markup]:
    checks = of_outcome(verdict, "pass")
    if checks and folded:
        count = "1 check passes" if len(checks) == 1 else f"{len(checks)} checks pass"
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
    return joined(
        lesson, ", in the lesson that ", tag("code", f"{program} lab {int(found[2])}"), " opens"
    )


def _failed(check: CheckResult, package: str, plot: Markup, read: Markup) -> Markup:
    expected, measured = check.expected or "", check.measured or ""
    seen = {"expected": marked(expected, measured), "measured": marked(measured, expected)}
    rows = {"why": prose(check.why or ""), "try": prose(check.hint or ""), "read": read}
    return tag(
        "article",
        tag("h3", _mark("fail"), " ", prose(check.title)),
        tag("p", tag("code", check.id), f" · {points_of(check)} points", class_="about"),
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


def _row_of(label: str, text: Markup) -> Markup:
    return tag("div", tag("dt", label), tag("dd", text))


def _log(check: CheckResult, package: str) -> Iterator[Markup]:
    lines = helpful(check.log, package, LOG_LINES)
    if lines:
        yield tag("p", "The last lines that came out:", class_="about")
        yield tag("pre", "\n".join(lines), tabindex="0")


def _hints(check: CheckResult) -> Iterator[Markup]:
    """Each step folded: who reads one does not see the next."""
    for number, (step, hint) in enumerate(zip(STEPS, check.hints, strict=False), start=1):
        summary = tag("summary", f"Hint {number}: {step}")
        yield tag("details", summary, tag("pre", hint, tabindex="0", class_="hint"))
    if check.mend:
        yield tag("details", tag("summary", "What mends it"), tag("p", prose(check.mend)))


def _row(check: CheckResult) -> Markup:
    return tag(
        "li",
        _mark(check.outcome),
        tag("span", prose(check.title), class_="title"),
        tag("span", points_of(check), class_="points"),
        class_=check.outcome,
    )


def _mark(outcome: CheckOutcome) -> Markup:
    return tag("span", MARKS[outcome], class_="mark", role="img", aria_label=WORDS[outcome])
