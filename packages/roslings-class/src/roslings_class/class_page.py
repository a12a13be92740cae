"""The class on one page: what most have to mend, everybody in a table, who is alike."""

from __future__ import annotations

import re
import statistics
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from ros2_on_pip.markup import Markup, prose, tag
from roslings.course import Lab
from roslings.grading.saving import required_rates
from roslings_class.changes import Regrading
from roslings_class.class_table import everybody, page_link
from roslings_class.grades import SAY_WHOSE, Class, StudentGrade
from roslings_class.result import GradingResult
from roslings_class.similar import Pair, alike, equal_groups
from roslings_class.sorted_table import write_page

MOST_SHOWN = 8
"""More are folded away: the table of the class comes soon."""
STEPS = 10
WORDS = 3
"""More in a cell are a sentence."""
TAG = re.compile("<[^>]*>")
WIDTH, HEIGHT = 720.0, 60.0


def write_class_page(
    lab: Lab,
    found: Class,
    common: Iterable[int],
    path: Path,
    regrading: Regrading | None = None,
) -> None:
    """Write the page; `common` are the marks of the starter. Raises CannotWriteFile."""
    parts = _parts(lab, found, common, regrading)
    write_page(path, f"Lab {lab.name}", lab.card.title, parts)


def _parts(
    lab: Lab, found: Class, common: Iterable[int], regrading: Regrading | None
) -> Iterator[Markup]:
    own = {grade.submission: grade.result for grade in found.grades if grade.result}
    results = list(own.values())  # a team's hand-in is one
    yield from (*_overview(found), *_first(results, found.grades))
    yield from (*_judged_again(regrading, found.grades), everybody(found.grades))
    yield from (*_missing(found.missing), *_loose_ends(found), *_unusual(results))
    yield from (*_rates(lab, results), *_alike(results, common))


def _first(results: Sequence[GradingResult], grades: Sequence[StudentGrade]) -> Iterator[Markup]:
    """What most have to mend, and how the points spread: side by side where there is room."""
    parts = [*_checks(results), *_scores(grades)]
    if parts:
        yield tag("div", *parts, class_="first")


def _overview(found: Class) -> Iterator[Markup]:
    counts = Counter(grade.outcome for grade in found.grades)
    items = [tag("li", f"{count} {word}", class_=word) for word, count in counts.most_common()]
    yield tag("ul", *items, class_="counts")
    scores = [grade.final for grade in found.grades if grade.final is not None]
    if scores:
        mean, median = statistics.fmean(scores), statistics.median(scores)
        yield tag("p", f"Scores: mean {mean:.0f}, median {median:g}, of {len(scores)}.")


def _scores(grades: Sequence[StudentGrade]) -> Iterator[Markup]:
    scores = [grade.final for grade in grades if grade.final is not None]
    if not scores:
        return
    counts = Counter(min(int(score // STEPS), STEPS - 1) for score in scores)
    rows = [
        _row(
            (
                f"{step * STEPS} to {step * STEPS + STEPS}",
                _part(counts[step] / len(scores)),
                str(counts[step]),
            )
        )
        for step in range(STEPS)
    ]
    yield tag("section", tag("h2", "Scores"), _table(("score", "part of all", "how many"), rows))


def _checks(results: Sequence[GradingResult]) -> Iterator[Markup]:
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
        name: _row(
            (
                _find(name),
                prose(titles[name]),
                _part(_failed_part(counts[name])),
                str(counts[name]["fail"]),
                str(counts[name]["skip"]),
            )
        )
        for name in failing
    }
    failed = [row for name, row in rows.items() if counts[name]["fail"]]
    waiting = [row for name, row in rows.items() if not counts[name]["fail"]]
    heading = tag("h2", "What most have to mend")
    shown, more = failed[:MOST_SHOWN], failed[MOST_SHOWN:]
    folded = (
        _folded(f"{len(more)} more that somebody failed", _check_table(more)),
        _folded(f"{len(waiting)} that were only skipped", _check_table(waiting)),
    )
    yield tag("section", heading, *_check_table(shown), *folded[0], *folded[1])


def _folded(words: str, inside: Iterable[Markup]) -> Iterator[Markup]:
    if parts := [*inside]:
        yield tag("details", tag("summary", words), *parts)


def _find(check: str) -> Markup:
    """The name of a check; pressed, it shows who failed it."""
    return tag("a", tag("code", check), href="#everybody", data_find=check)


def _check_table(rows: Sequence[Markup]) -> Iterator[Markup]:
    if rows:
        head = ("check", "what it asks", "part of all", "fail", "skipped")
        yield _table(head, rows, name="checks-most")


def _failed_part(counts: Counter[str]) -> float:
    return counts["fail"] / max(1, sum(counts.values()))


# --- rates -------------------------------------------------------------------------------------


def _rates(lab: Lab, results: Sequence[GradingResult]) -> Iterator[Markup]:
    """Of those who have everybody's card: where cards differ, there is no one right rate."""
    figures = []
    alike = [result.rates for result in results if not result.words]
    for asked in required_rates(lab):
        rates = [found[asked.topic] for found in alike if asked.topic in found]
        if rates:
            low, high = min(asked.low_hz, *rates), max(asked.high_hz, *rates)
            words = (
                f"{asked.topic}: {len(rates)} rates from {min(rates):.4g} to {max(rates):.4g} Hz;"
                f" {asked.low_hz:.4g} to {asked.high_hz:.4g} Hz is right"
            )
            picture = _spread(rates, (asked.low_hz, asked.high_hz), (low, high))
            axis = tag(
                "p", tag("span", f"{low:.4g} Hz"), tag("span", f"{high:.4g} Hz"), class_="axis-ends"
            )
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
        "svg",
        band,
        line,
        *dots,
        viewBox=f"0 0 {WIDTH:g} {HEIGHT:g}",
        class_="spread",
        aria_hidden="true",
        preserveAspectRatio="none",
    )


# --- who is alike ------------------------------------------------------------------------------


def _alike(results: Sequence[GradingResult], common: Iterable[int]) -> Iterator[Markup]:
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
    near = [_row((page_link(p.one), page_link(p.other), _percent(p), str(p.marks))) for p in pairs]
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
        *(
            tag(
                "li",
                f"{name} handed in several: {', '.join(names)}; the newest that was graded counts",
            )
            for name, names in found.twice.items()
        ),
    ]
    step = [tag("p", prose(SAY_WHOSE))] if found.unclear else []
    if items:
        heading = tag("h2", "What does not fit the class list")
        yield tag("section", heading, tag("ul", *items), *step)


def _unusual(results: Sequence[GradingResult]) -> Iterator[Markup]:
    """Also of whom no verdict could be told: its neighbours may have waited for it."""
    rows = [
        _row((page_link(each.submission), line))
        for each in results
        for line in (*each.unusual, *([each.reason] if each.state == "broken" else []))
    ]
    if rows:
        about = tag(
            "p",
            "A mistake can do this as well as intent. It changed no one else's score.",
            class_="about",
        )
        table = _table(("submission", "what it did"), [*rows])
        yield tag("section", tag("h2", "What was not ordinary"), about, table)


def _missing(grades: Sequence[StudentGrade]) -> Iterator[Markup]:
    rows = [_row((who.name, who.id, who.email)) for each in grades if (who := each.student)]
    if rows:
        heading = f"Handed in nothing ({len(rows)})"
        yield tag("section", tag("h2", heading), _table(("who", "id", "address"), rows))


def _judged_again(regrading: Regrading | None, grades: Sequence[StudentGrade]) -> Iterator[Markup]:
    """After a regrade: who, which check, from, to."""
    if regrading is None:
        return
    rows = [
        _row((page_link(each.submission, who), tag("code", each.check), each.before, each.after))
        for who, each in regrading.told(grades)
    ]
    about = tag("p", regrading.summary, class_="about")
    shown, more = rows[:MOST_SHOWN], rows[MOST_SHOWN:]
    folded = _folded(f"{len(more)} more changes", _changes_table(more))
    heading = tag("h2", "Judged again")
    yield tag("section", heading, about, *_changes_table(shown), *folded)


def _changes_table(rows: Sequence[Markup]) -> Iterator[Markup]:
    if rows:
        yield _table(("who", "check", "from", "to"), rows)


def _table(head: Sequence[str], rows: Sequence[Markup], name: str | None = None) -> Markup:
    """In a holder of its own, which scrolls where a screen is narrower than one long word."""
    top = tag("tr", *(tag("th", cell, scope="col") for cell in head))
    table = tag("table", tag("thead", top), tag("tbody", *rows), class_=name)
    label = f"table: {', '.join(filter(None, head))}"
    return tag("div", table, class_="holder", tabindex="0", role="group", aria_label=label)


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
        "svg",
        bar,
        viewBox="0 0 100 10",
        preserveAspectRatio="none",
        aria_hidden="true",
        class_="part",
    )
