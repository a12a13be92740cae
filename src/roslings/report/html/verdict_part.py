"""The verdict on the page: the score, what to mend with its hints, what is right."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from roslings.report.check_lines import LOG_LINES, points_of
from roslings.report.hint_page import STEPS
from roslings.report.html.markup import Markup, joined, prose, tag
from roslings.report.log_lines import helpful
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
MARKS: dict[CheckOutcome, str] = {"pass": "✓", "fail": "✗", "skip": "-", "inconclusive": "?"}


def head(verdict: Verdict) -> Markup:
    """What was checked, and what came of it."""
    return tag(
        "header",
        tag("p", f"Lab {verdict.lab} · package {verdict.package}", class_="over"),
        tag("h1", HEADLINES[verdict.outcome]),
        _score(verdict),
        _counts(verdict),
        class_=verdict.outcome,
    )


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
        if (some := _of(verdict, outcome))
    ]
    return tag("ul", *counts, class_="counts")


def _of(verdict: Verdict, outcome: CheckOutcome) -> list[CheckResult]:
    return [check for check in verdict.checks if check.outcome == outcome]


def body(verdict: Verdict) -> Iterator[Markup]:
    """The checks: those to mend first, each whole; then the others."""
    failed = [_failed(check, verdict.package) for check in verdict.failed()]
    if failed:
        yield tag("section", tag("h2", "What to mend"), *failed)
    if verdict.advice:
        remarks = [tag("li", prose(remark)) for remark in verdict.advice]
        heading = tag("h2", "Remarks that cost no points")
        yield tag("section", heading, tag("ul", *remarks))
    others = [_row(check) for outcome in ("inconclusive", "skip", "pass")
              for check in _of(verdict, outcome)]  # fmt: skip
    if others:
        heading = tag("h2", "All other checks" if failed else "The checks")
        yield tag("section", heading, tag("ul", *others, class_="checks"))


def _failed(check: CheckResult, package: str) -> Markup:
    rows = {
        "expected": check.expected,
        "measured": check.measured,
        "why": check.why,
        "try": check.hint,
        "read": check.lesson,
    }
    return tag(
        "article",
        tag("h3", _mark("fail"), " ", prose(check.title)),
        tag("p", tag("code", check.id), f" · {points_of(check)} points", class_="about"),
        tag("dl", *(_row_of(label, text) for label, text in rows.items() if text)),
        *_log(check, package),
        *_hints(check.hints),
        id=f"check-{check.id}",
    )


def _row_of(label: str, text: str) -> Markup:
    return tag("div", tag("dt", label), tag("dd", prose(text)))


def _log(check: CheckResult, package: str) -> Iterator[Markup]:
    lines = helpful(check.log, package, LOG_LINES)
    if lines:
        yield tag("p", "The last lines that came out:", class_="about")
        yield tag("pre", "\n".join(lines), tabindex="0")


def _hints(hints: Sequence[str]) -> Iterator[Markup]:
    """Each step folded: who reads one does not see the next."""
    for number, (step, hint) in enumerate(zip(STEPS, hints, strict=False), start=1):
        summary = tag("summary", f"Hint {number}: {step}")
        yield tag("details", summary, tag("pre", hint, tabindex="0", class_="hint"))


def _row(check: CheckResult) -> Markup:
    why = tag("span", prose(check.why), class_="why") if check.why else ""
    return tag(
        "li",
        _mark(check.outcome),
        tag("span", prose(check.title), class_="title"),
        tag("span", points_of(check), class_="points"),
        why,
        class_=check.outcome,
    )


def _mark(outcome: CheckOutcome) -> Markup:
    return tag("span", MARKS[outcome], class_="mark", role="img", aria_label=WORDS[outcome])
