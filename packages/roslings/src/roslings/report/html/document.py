"""The whole page, made from a verdict and its evidence alone."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.graph.drawing import STYLE as GRAPH_STYLE
from ros2_on_pip.language import language, said
from ros2_on_pip.markup import Markup, joined, tag, told
from roslings.capability import capabilities
from roslings.evidence import Evidence
from roslings.report.command_line import CommandLine
from roslings.report.html import seen_part, verdict_part
from roslings.report.html.intervals import RequiredRate, watched
from roslings.report.whole_file import write_whole
from roslings.verdict import Verdict
from roslings_rover.palette import variables

STYLE = Path(__file__).with_name("style.css")
MARK = Path(__file__).with_name("roslings.svg")
POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
"""What the browser may do with this page: draw it, with the pictures that it carries itself. No
script, no address, whatever stands in it."""


@dataclass(frozen=True)
class OfClass:
    """Whose page it is. It is handed on alone, so it names no page of the class."""

    student: str
    counts: str = ""
    """What counts beside the measured score; empty where that is all."""


@dataclass(frozen=True)
class Own:
    """Of a page about one's own package: how it was checked, and where the lessons can be read."""

    command_line: CommandLine
    site: str = ""
    """The address of the built site, without a slash at its end; empty where there is none."""


Reader = OfClass | Own
"""For whom a page is made."""


def write_html(
    verdict: Verdict,
    evidence: Evidence,
    asked: Sequence[RequiredRate],
    path: Path,
    reader: Reader | None = None,
) -> None:
    """Write the page to `path`, whole or not at all. Raises CannotWriteFile."""
    write_whole(path, html_of(verdict, evidence, asked, reader).encode("utf-8"))


def html_of(
    verdict: Verdict,
    evidence: Evidence,
    asked: Sequence[RequiredRate],
    reader: Reader | None = None,
) -> str:
    """The page; `asked` are the rates that the lab asks for."""
    whose = reader.student if isinstance(reader, OfClass) else ""
    body = _body(verdict, evidence, asked, reader)
    page = tag("html", _head(verdict, whose), body, lang=language().replace("_", "-"))
    return f"<!DOCTYPE html>\n{page}\n"


def _head(verdict: Verdict, whose: str) -> Markup:
    title = said(
        "page.title",
        "{whose}: {score} (lab {lab})",
        whose=whose or verdict.package,
        score=_score(verdict),
        lab=verdict.lab,
    )
    return tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=POLICY),
        tag("meta", name_="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", name_="color-scheme", content="light dark"),
        tag("title", title),
        style(),
    )


def _score(verdict: Verdict) -> str:
    if verdict.score is None:
        return str(verdict_part.NO_SCORE)
    return said("page.title.score", "{score:g} of 100", score=verdict.score)


def style(more: str = "") -> Markup:
    """The style of every page of the engine, in the colours of the course; `more` is a page's own.

    `color-scheme` stands in it, and not only in the head: so the pictures on the page know, too.
    """
    return tag("style", Markup(variables() + STYLE.read_text("utf-8") + GRAPH_STYLE + more))


def brand(*beside: Markup) -> Markup:
    """The line above a page's title: the course's mark and name, and links beside them."""
    name = tag("span", _mark(), "roslings", class_="brand")
    return tag("nav", name, *beside, class_="top", aria_label="roslings")


def _mark() -> Markup:
    """The drawing without what it has as a file of its own: a name space, and its name in words."""
    drawing = MARK.read_text("utf-8")
    return Markup(re.sub("<svg [^>]*>", '<svg viewBox="0 0 64 64" aria-hidden="true">', drawing))


def _body(
    verdict: Verdict, evidence: Evidence, asked: Sequence[RequiredRate], reader: Reader | None
) -> Markup:
    of_class = reader if isinstance(reader, OfClass) else None
    own = reader if isinstance(reader, Own) else Own(CommandLine(verdict.lab))
    heard = watched(evidence, asked)
    plots = seen_part.rate_plots(verdict, heard)
    figures = {check: seen_part.topic(each) for check, each in plots.items()}
    rest = [each for each in heard if not any(each is plot for plot in plots.values())]
    parts = joined(
        *verdict_part.body(verdict, figures, own.site, own.command_line.program),
        *(section for each in capabilities() for section in each.sections_of(evidence)),
        *seen_part.topics(evidence, rest),
        *seen_part.spoken(evidence),
        *seen_part.graphs(evidence),
        *seen_part.processes(evidence),
        *seen_part.set_aside(evidence),
        *seen_part.logs(evidence),
        seen_part.surroundings(verdict),
    )
    again = told(
        "page.again",
        "Judge the saved evidence again, without running anything: {command}",
        command=tag("code", f"./roslings regrade {verdict.lab} EVIDENCE"),
    )
    whose = of_class.student if of_class else ""
    counts = of_class.counts if of_class else ""
    head = joined(brand(), verdict_part.head(verdict, own.command_line, whose, counts))
    return tag("body", head, tag("main", parts), tag("footer", again))
