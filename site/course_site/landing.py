"""What a visitor sees first: two buttons, the rover, and beside it a verdict of the course."""

from __future__ import annotations

import io
from html import escape
from pathlib import Path

from docutils import nodes
from rich.console import Console
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from course_site.course import html, lessons_of
from ros2_on_pip.language import said
from roslings.report.check_lines import WORDS
from roslings.report.json_file import read_json
from roslings.report.terminal import print_verdict

VERDICT = Path(__file__).parents[1] / "pictures" / "verdict.json"
FAILED = "✗"
COLUMNS = 46
"""So wide that it stands beside the rover, and can be read on a telephone."""
FIRST_PAGES = ("days/01-install/first-15-minutes", "days/01-install/index", "reference/installing")
WINDOW_TITLE = "A day in one window"
WINDOW_PAGE, WINDOW = "reference/installing", "the-day-in-one-window"
"""What the second button leads to: the page, and the place on it."""
SAID = "One letter is missing in a program. The course ran it, and says this."
ROVER = "A small robot drives round a room, along a dotted line, past a red ball."
LEAD = (
    "{days} days, from the first two programs that talk to a robot that sees. You build each part"
    " yourself. The course runs what you built, and says what to do next."
)


class Hero(SphinxDirective):
    """`{hero}`: what the course is, the buttons that begin, the rover, and a verdict."""

    def run(self) -> list[nodes.Node]:
        """The first of the first pages that this course has."""
        self.env.note_dependency(str(VERDICT))
        first = next(page for page in FIRST_PAGES if page in self.env.found_docs)
        days = len(lessons_of(self.config).days)
        return [
            html(
                '<div class="hero"><div class="hero-words"><p class="lead">'
                f"{said('site.home.lead', LEAD, days=days)}</p>"
                f'<p class="actions"><a class="button" href="{first}.html">'
                f"{said('site.home.begin', 'Drive a robot in 15 minutes')}</a>"
                f"{self._second_button()}</p></div>"
                '<div class="hero-room">'
                '<img src="_static/rover.svg" width="304" height="400"'
                f' alt="{said("site.home.rover", ROVER)}"></div>'
                f'<figure class="hero-verdict"><pre class="verdict">{marked()}</pre>'
                f"<figcaption>{said('site.home.verdict', SAID)}</figcaption></figure></div>"
                '<p class="note-box review-due" hidden><span></span> '
                f'<a href="review.html">{said("site.home.review", "Review them")}</a></p>'
            )
        ]

    def _second_button(self) -> str:
        """How a whole day stands in one page of a browser, also where nothing can be installed."""
        if WINDOW_PAGE not in self.env.found_docs:
            return ""
        address = f"{WINDOW_PAGE}.html#{WINDOW}"
        title = said("site.home.window", WINDOW_TITLE)
        return f' <a class="button plain" href="{address}">{title}</a>'


def marked() -> str:
    """The same as HTML, its first words in the colour of what failed."""
    failed = f"{FAILED} {WORDS['fail']}"
    return escape(printed()).replace(failed, f'<b class="failed">{failed}</b>', 1)


def printed() -> str:
    """How a terminal without colours ends with the kept verdict: from what failed to what is next.

    Raises ValueError where nothing failed.
    """
    console = Console(file=io.StringIO(), record=True, width=COLUMNS, color_system=None)
    print_verdict(read_json(VERDICT), console=console)
    text = console.export_text()
    return text[text.index(FAILED) :].strip("\n")


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_directive("hero", Hero)
