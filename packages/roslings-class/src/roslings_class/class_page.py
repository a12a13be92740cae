"""The class on one page: what most have to mend, how their rates spread, who is alike."""

from __future__ import annotations

import re
import statistics
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from roslings.course import Lab
from roslings.report.flow import one_line
from roslings.report.html.document import POLICY, brand, style
from roslings.report.html.markup import Markup, prose, tag
from roslings.report.whole_file import write_whole
from roslings.saving import asked_rates
from roslings_class.grades import SAY_WHOSE, Class, Grade
from roslings_class.result import Result
from roslings_class.similar import Pair, alike, equal_groups
from roslings_class.student_pages import folder_name

OWN_STYLE = """
.holder { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .6rem .3rem 0; text-align: left; vertical-align: top; }
th { border-bottom: 1px solid var(--edge); }
th, td code { overflow-wrap: normal; white-space: nowrap; }
th:first-child, td:first-child { min-width: 4.5rem; overflow-wrap: break-word; }
td.words { min-width: 11rem; overflow-wrap: break-word; }
th:first-child, td:first-child { position: sticky; left: 0; background: var(--ground); }
.outcome { white-space: nowrap; }
.outcome.pass { color: var(--good); }
.outcome.fail { color: var(--bad); }
.outcome.inconclusive, .outcome.refused, .outcome.unclear { color: var(--open); }
.counts .refused, .counts .unclear { color: var(--open); }
.axis-ends { display: flex; justify-content: space-between; font-size: .85rem; }
svg.part { width: 8rem; height: .7rem; vertical-align: middle; }
svg.part rect { fill: var(--link); }
@media (max-width: 640px) { svg.part { width: 3rem; } }
svg.spread { display: block; width: 100%; height: 5rem; }
svg.spread rect.right { fill: var(--band); }
svg.spread line { stroke: var(--edge); }
svg.spread ellipse { fill: var(--dot); fill-opacity: .5; }
"""
STEPS = 10
WORDS = 3
"""More in a cell are a sentence."""
TAG = re.compile("<[^>]*>")
WIDTH, HEIGHT = 720.0, 60.0


def write_class_page(lab: Lab, found: Class, common: Iterable[int], path: Path) -> None:
    """Write the page; `common` are the marks of the starter. Raises CannotWrite."""
    page = tag("html", _head(lab), _body(lab, found, common), lang="en")
    write_whole(path, f"<!DOCTYPE html>\n{page}\n".encode())


def _head(lab: Lab) -> Markup:
    return tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=POLICY),
        tag("meta", name_="viewport", content="width=device-width, initial-scale=1"),
        tag("title", f"The class: {lab.card.title}"),
        style(OWN_STYLE),
    )


def _body(lab: Lab, found: Class, common: Iterable[int]) -> Markup:
    results = [grade.result for grade in found.grades if grade.result]
    parts = (
        *_overview(found), *_everybody(found.grades), *_missing(found.missing),
        *_loose_ends(found), *_unusual(results), *_checks(results), *_scores(found.grades),
        *_rates(lab, results), *_alike(results, common),
    )  # fmt: skip
    header = tag("header", tag("p", f"Lab {lab.name}", class_="over"), tag("h1", lab.card.title))
    return tag("body", brand(), header, tag("main", *parts))


def _overview(found: Class) -> Iterator[Markup]:
    counts = Counter(grade.outcome for grade in found.grades)
    items = [tag("li", f"{count} {word}", class_=word) for word, count in counts.most_common()]
    yield tag("ul", *items, class_="counts")
    scores = [grade.final for grade in found.grades if grade.final is not None]
    if scores:
        mean, median = statistics.fmean(scores), statistics.median(scores)
        yield tag("p", f"Scores: mean {mean:.0f}, median {median:g}, of {len(scores)}.")


def _scores(grades: Sequence[Grade]) -> Iterator[Markup]:
    scores = [grade.final for grade in grades if grade.final is not None]
    if not scores:
        return
    counts = Counter(min(int(score // STEPS), STEPS - 1) for score in scores)
    rows = [
        _row((f"{step * STEPS} to {step * STEPS + STEPS}", _part(counts[step] / len(scores)),
              str(counts[step])))
        for step in range(STEPS)
    ]  # fmt: skip
    yield tag("section", tag("h2", "Scores"), _table(("score", "part of all", "how many"), rows))


def _checks(results: Sequence[Result]) -> Iterator[Markup]:
    """Those that fail most come first."""
    checks = [c for result in results if result.verdict for c in result.verdict.checks]
    counts: defaultdict[str, Counter[str]] = defaultdict(Counter)
    titles = {check.id: check.title for check in checks}
    for check in checks:
        counts[check.id][check.outcome] += 1
    failing = [name for name in counts if counts[name]["fail"] or counts[name]["skip"]]
    if not failing:
        return
    failing.sort(key=lambda name: (-counts[name]["fail"], -counts[name]["skip"]))
    rows = {
        name: _row((tag("code", name), prose(titles[name]), _part(_failed_part(counts[name])),
                    str(counts[name]["fail"]), str(counts[name]["skip"])))
        for name in failing
    }  # fmt: skip
    failed = [row for name, row in rows.items() if counts[name]["fail"]]
    waiting = [row for name, row in rows.items() if not counts[name]["fail"]]
    heading = tag("h2", "What most have to mend")
    yield tag("section", heading, *_check_table(failed), *_folded_checks(waiting))


def _check_table(rows: Sequence[Markup]) -> Iterator[Markup]:
    if rows:
        yield _table(("check", "what it asks", "part of all", "fail", "skipped"), rows)


def _folded_checks(rows: Sequence[Markup]) -> Iterator[Markup]:
    """Those that nobody failed: they wait for another check."""
    if rows:
        words = tag("summary", f"{len(rows)} that were only skipped")
        yield tag("details", words, *_check_table(rows))


def _failed_part(counts: Counter[str]) -> float:
    return counts["fail"] / max(1, sum(counts.values()))


# --- rates -------------------------------------------------------------------------------------


def _rates(lab: Lab, results: Sequence[Result]) -> Iterator[Markup]:
    figures = []
    for asked in asked_rates(lab):
        rates = [result.rates[asked.topic] for result in results if asked.topic in result.rates]
        if rates:
            low, high = min(asked.low_hz, *rates), max(asked.high_hz, *rates)
            words = (
                f"{asked.topic}: {len(rates)} rates from {min(rates):.4g} to {max(rates):.4g} Hz;"
                f" {asked.low_hz:.4g} to {asked.high_hz:.4g} Hz is right"
            )
            picture = _spread(rates, (asked.low_hz, asked.high_hz), (low, high))
            axis = tag("p", tag("span", f"{low:.4g} Hz"), tag("span", f"{high:.4g} Hz"),
                       class_="axis-ends")  # fmt: skip
            figures.append(tag("figure", picture, axis, tag("figcaption", words)))
    if figures:
        yield tag("section", tag("h2", "How the rates spread"), *figures)


def _spread(
    rates: Sequence[float], right: tuple[float, float], whole: tuple[float, float]
) -> Markup:
    """A dot a submission, on a line from the slowest to the fastest; the band is right."""
    span = (whole[1] - whole[0]) or 1.0

    def across(hz: float) -> float:
        return 10.0 + (WIDTH - 20.0) * (hz - whole[0]) / span

    left, end = across(right[0]), across(right[1])
    band = tag("rect", x=left, y=0.0, width=max(end - left, 1.0), height=HEIGHT, class_="right")
    line = tag("line", x1=0.0, x2=WIDTH, y1=HEIGHT / 2, y2=HEIGHT / 2)
    dots = [
        tag("ellipse", cx=across(hz), cy=HEIGHT / 2 + 7.0 * (number % 5 - 2), rx=4.0, ry=4.0)
        for number, hz in enumerate(sorted(rates))
    ]
    return tag(
        "svg", band, line, *dots, viewBox=f"0 0 {WIDTH:g} {HEIGHT:g}", class_="spread",
        aria_hidden="true", preserveAspectRatio="none",
    )  # fmt: skip


# --- who is alike ------------------------------------------------------------------------------


def _alike(results: Sequence[Result], common: Iterable[int]) -> Iterator[Markup]:
    groups, pairs = equal_groups(results), alike(results, common)
    if not groups and not pairs:
        return
    about = tag(
        "p",
        "Found by comparing the code with names, numbers and texts left out (winnowing). Only a"
        " person can tell why two are alike: read both.",
        class_="about",
    )
    equal = [tag("li", f"word for word the same: {', '.join(names)}") for names in groups]
    near = [_row((_link(p.one), _link(p.other), _percent(p), str(p.marks))) for p in pairs]
    table = [_table(("one", "other", "alike", "places"), near)] if near else []
    lists = [tag("ul", *equal)] if equal else []
    yield tag("section", tag("h2", "Nearly the same"), about, *lists, *table)


def _percent(pair: Pair) -> str:
    return f"{100 * pair.likeness:.0f} %"


# --- everybody ---------------------------------------------------------------------------------


def _loose_ends(found: Class) -> Iterator[Markup]:
    items = [
        *(tag("li", f"{name} is of nobody in the class list") for name in found.unknown),
        *(tag("li", f"{grade.submission}: {grade.doubt}") for grade in found.unclear),
        *(tag("li", f"{name} handed in several: {', '.join(names)}; the newest that was"
              " graded counts")
          for name, names in found.twice.items()),
    ]  # fmt: skip
    step = [tag("p", prose(SAY_WHOSE))] if found.unclear else []
    if items:
        heading = tag("h2", "What does not fit the class list")
        yield tag("section", heading, tag("ul", *items), *step)


def _unusual(results: Sequence[Result]) -> Iterator[Markup]:
    """Also of whom no verdict could be told: its neighbours may have waited for it."""
    rows = [
        _row((_link(each.submission), line))
        for each in results
        for line in (*each.unusual, *([each.reason] if each.state == "broken" else []))
    ]
    if rows:
        about = tag("p", "A mistake can do this as well as intent. It changed no one else's score.",
                    class_="about")  # fmt: skip
        table = _table(("submission", "what it did"), [*rows])
        yield tag("section", tag("h2", "What was not ordinary"), about, table)


def _missing(grades: Sequence[Grade]) -> Iterator[Markup]:
    rows = [_row((who.name, who.id, who.email)) for each in grades if (who := each.student)]
    if rows:
        heading = f"Handed in nothing ({len(rows)})"
        yield tag("section", tag("h2", heading), _table(("who", "id", "address"), rows))


def _everybody(grades: Sequence[Grade]) -> Iterator[Markup]:
    """The lowest score first: these are to be looked at."""
    rows = [
        _row((grade.name, _link(grade.submission) if grade.submission else "", _outcome(grade),
              _score(grade), _remark(grade)))
        for grade in sorted(grades, key=lambda grade: (-1.0 if grade.final is None
                                                       else grade.final))
    ]  # fmt: skip
    head = ("who", "submission", "outcome", "score", "remark")
    yield tag("section", tag("h2", "Everybody"), _table(head, rows))


def _outcome(grade: Grade) -> Markup:
    return tag("span", grade.outcome, class_=f"outcome {grade.outcome}")


def _score(grade: Grade) -> str:
    return "-" if grade.final is None else f"{grade.final:g}"


def _remark(grade: Grade) -> str:
    if grade.override:
        measured = "none" if grade.measured is None else f"{grade.measured:g}"
        who = f"{grade.override.by}: {grade.override.reason}"
        return f"score given by a person (measured: {measured}). {who}"
    if grade.doubt:
        return grade.doubt
    late = f"{grade.late_days} days late, costs {grade.late_points:g}. " if grade.late_days else ""
    return late + (one_line(grade.result.reason) if grade.result else "")


def _link(submission: str) -> Markup:
    return tag("a", submission, href=f"students/{folder_name(submission)}/report.html")


def _table(head: Sequence[str], rows: Sequence[Markup]) -> Markup:
    """In a holder of its own, which scrolls where a screen is narrow; its first column stays."""
    top = tag("tr", *(tag("th", cell, scope="col") for cell in head))
    table = tag("table", tag("thead", top), tag("tbody", *rows))
    name = f"table: {', '.join(filter(None, head))}"
    return tag("div", table, class_="holder", tabindex="0", role="group", aria_label=name)


def _row(cells: Sequence[str]) -> Markup:
    return tag("tr", *map(_cell, cells))


def _cell(text: str) -> Markup:
    """A sentence gets room, a name or a number only what it needs."""
    words = TAG.sub("", text).split()
    return tag("td", text, class_="words" if len(words) > WORDS else None)


def _part(part: float) -> Markup:
    """A bar as long as the part of the class."""
    bar = tag("rect", x=0.0, y=0.0, width=100.0 * part, height=10.0)
    return tag(
        "svg", bar, viewBox="0 0 100 10", preserveAspectRatio="none", aria_hidden="true",
        class_="part",
    )  # fmt: skip
