"""The box under a lesson's title: on this page nothing runs, and this is how to open it."""

from __future__ import annotations

import re

from docutils import nodes
from sphinx.application import Sphinx

from course_site.course import html, lessons_of
from roslings.lessons import Day

PRESS_KEYS = re.compile(r"[^.]*\b(?:press|hold)\b[^.]*\bShift\b[^.]*\.")
INSTEAD = "In JupyterLab, you run the cell below."


def day_of(app: Sphinx, page: str) -> Day | None:
    """The day whose lesson a page is."""
    return next((d for d in lessons_of(app.config).days if page == f"days/{d.id}/index"), None)


def forget_keys(app: Sphinx, document: nodes.document) -> None:
    """A lesson tells to press keys; on the site nobody can."""
    if day_of(app, app.env.docname) is None:
        return
    for text in list(document.findall(nodes.Text)):
        if not isinstance(text.parent, nodes.literal) and PRESS_KEYS.search(text.astext()):
            told = PRESS_KEYS.sub(INSTEAD, text.astext(), count=1)
            text.parent.replace(text, nodes.Text(told))


def add_box(app: Sphinx, document: nodes.document, page: str) -> None:
    """Put the box under the title."""
    day = day_of(app, page)
    title = next(document.findall(nodes.title), None)
    if day and title is not None and app.builder.format == "html":
        place = title.parent.index(title)
        title.parent.insert(place + 1, html(_box(day)))


def _box(day: Day) -> str:
    return (
        '<div class="run-box"><p><b>Run this page on your computer.</b> '
        "In a terminal, in the roslings folder:</p>"
        f"<pre data-copy>./roslings lab {day.number}</pre></div>"
    )


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("doctree-read", forget_keys, priority=400)  # before words become links
    app.connect("doctree-resolved", add_box)
