"""The whole page, made from a verdict and its evidence alone."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from roslings.evidence import Evidence
from roslings.report.html import seen_part, shown_part, verdict_part
from roslings.report.html.intervals import Asked, watched
from roslings.report.html.markup import Markup, joined, tag
from roslings.report.whole_file import write_whole
from roslings.verdict import Verdict

STYLE = Path(__file__).with_name("style.css")
POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
"""What the browser may do with this page: draw it, with the pictures that it carries itself. No
script, no address, whatever stands in it."""


def write_html(verdict: Verdict, evidence: Evidence, asked: Sequence[Asked], path: Path) -> None:
    """Write the page to `path`, whole or not at all. Raises CannotWrite."""
    write_whole(path, html_of(verdict, evidence, asked).encode("utf-8"))


def html_of(verdict: Verdict, evidence: Evidence, asked: Sequence[Asked]) -> str:
    """The page; `asked` are the rates that the lab asks for."""
    page = tag("html", _head(verdict), _body(verdict, evidence, asked), lang="en")
    return f"<!DOCTYPE html>\n{page}\n"


def _head(verdict: Verdict) -> Markup:
    score = "no score" if verdict.score is None else f"{verdict.score:g} of 100"
    return tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=POLICY),
        tag("meta", name_="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", name_="color-scheme", content="light dark"),
        tag("title", f"{verdict.package}: {score} (lab {verdict.lab})"),
        tag("style", Markup(STYLE.read_text("utf-8"))),
    )


def _body(verdict: Verdict, evidence: Evidence, asked: Sequence[Asked]) -> Markup:
    heard = watched(evidence, asked)
    plots = seen_part.rate_plots(verdict, heard)
    figures = {check: seen_part.topic(each) for check, each in plots.items()}
    rest = [each for each in heard if not any(each is plot for plot in plots.values())]
    parts = joined(
        *verdict_part.body(verdict, figures),
        *shown_part.pictures(evidence),
        *shown_part.ways(evidence),
        *seen_part.topics(evidence, rest),
        *seen_part.said(evidence),
        *seen_part.graphs(evidence),
        *seen_part.processes(evidence),
        *seen_part.set_aside(evidence),
        *seen_part.logs(evidence),
        seen_part.surroundings(verdict),
    )
    again = joined(
        "Judge the saved evidence again, without running anything: ",
        tag("code", f"./roslings regrade {verdict.lab} EVIDENCE"),
    )
    return tag("body", verdict_part.head(verdict), tag("main", parts), tag("footer", again))
