"""What a visitor sees first: the rover, one button, and a verdict as the course gives it."""

from __future__ import annotations

import io
from html import escape
from pathlib import Path

from docutils import nodes
from rich.console import Console
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from course_site.course import html
from roslings.report import print_verdict, read_json

VERDICT = Path(__file__).parents[1] / "pictures" / "verdict.json"
COLUMNS = 72
FIRST_PAGES = ("days/01-install/first-15-minutes", "days/01-install/index", "reference/installing")
ROVER = "A small robot drives round a room, along a dotted line, past a red ball."


class Hero(SphinxDirective):
    """`{hero}`: what the course is, the rover, and the button that begins."""

    def run(self) -> list[nodes.Node]:
        """The first of the first pages that this course has."""
        first = next(page for page in FIRST_PAGES if page in self.env.found_docs)
        return [html(
            '<div class="hero"><div><p class="lead">Seven days, from the first two programs that'
            " talk to a robot that sees. You build each part yourself. The course runs what you"
            " built, and says what to do next.</p>"
            f'<p class="actions"><a class="button" href="{first}.html">Drive a robot in 15 minutes'
            '</a></p></div>'
            f'<img src="_static/rover.svg" width="360" height="270" alt="{ROVER}"></div>'
            '<p class="note-box review-due" hidden><span></span> '
            '<a href="review.html">Review them</a></p>'
        )]  # fmt: skip


class RealVerdict(SphinxDirective):
    """`{real-verdict}`: a kept verdict, printed by the engine's own report."""

    def run(self) -> list[nodes.Node]:
        """The same text as in a terminal."""
        self.env.note_dependency(str(VERDICT))
        return [html(f'<pre class="verdict">{escape(printed())}</pre>')]


def printed() -> str:
    """The verdict as a terminal without colours shows it."""
    console = Console(file=io.StringIO(), record=True, width=COLUMNS, color_system=None)
    print_verdict(read_json(VERDICT), console=console)
    return console.export_text().strip("\n")


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_directive("hero", Hero)
    app.add_directive("real-verdict", RealVerdict)
