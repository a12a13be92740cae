"""The box under a lesson's title: on this page nothing runs, and this is how to open it."""

from __future__ import annotations

import re

from docutils import nodes
from sphinx.application import Sphinx

from course_site.course import html, lessons_of
from roslings_learn.lessons import Day

SENTENCE_ENDS = re.compile(r"(?<=\.)")
PRESS = re.compile(r"\b(?:press|hold)\b")
KEY = "Shift"
INSTEAD = "In JupyterLab, you run the cell below."


def day_of(app: Sphinx, page: str) -> Day | None:
    """The day whose lesson a page is."""
    return next((d for d in lessons_of(app.config).days if page == f"days/{d.id}/index"), None)


def forget_keys(app: Sphinx, document: nodes.document) -> None:
    """A lesson tells to press keys; on the site nobody can."""
    if day_of(app, app.env.docname) is None:
        return
    for text in list(document.findall(nodes.Text)):
        if KEY in text and not isinstance(text.parent, (nodes.literal, nodes.literal_block)):
            text.parent.replace(text, nodes.Text(without_keys(text.astext())))


def without_keys(text: str) -> str:
    """Each sentence that tells to press Shift is another one."""
    return "".join(map(_instead, SENTENCE_ENDS.split(text)))


def _instead(sentence: str) -> str:
    """With the blanks before it. Output of a cell can be long, and is no sentence."""
    if KEY not in sentence or not PRESS.search(sentence):
        return sentence
    blanks = sentence[: len(sentence) - len(sentence.lstrip())]
    return blanks + INSTEAD


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
