"""The box under a lesson's title: on this page nothing runs, and this is how to open it."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.config import Config
from sphinx.transforms import SphinxTransform

from course_site.course import BEFORE_TRANSLATION, html, lessons_of
from ros2_on_pip.language import said
from roslings_learn.lessons import Day

SENTENCE_ENDS = re.compile(r"(?<=\.)")
PRESS = re.compile(r"\b(?:press|hold)\b")
KEY = "Shift"
INSTEAD = "In JupyterLab, you run the cell below."
RUN = "<b>Run this page on your computer.</b> In a terminal, in the roslings folder:"


def day_of(config: Config, page: str) -> Day | None:
    """The day whose lesson a page is."""
    return next((d for d in lessons_of(config).days if page == f"days/{d.id}/index"), None)


class ForgottenKeys(SphinxTransform):
    """A lesson tells to press keys; on the site nobody can.

    What stands in their place is translated as all else is: so this is before that.
    """

    default_priority = BEFORE_TRANSLATION

    def apply(self, **_: Any) -> None:
        """In the text, and in the source that a translator has."""
        if day_of(self.config, self.env.docname) is None:
            return
        for text in list(self.document.findall(nodes.Text)):
            if KEY in text and not isinstance(text.parent, (nodes.literal, nodes.literal_block)):
                parent = text.parent
                parent.replace(text, nodes.Text(without_keys(text.astext())))
                parent.rawsource = without_keys(parent.rawsource)


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
    day = day_of(app.config, page)
    title = next(document.findall(nodes.title), None)
    if day and title is not None and app.builder.format == "html":
        place = title.parent.index(title)
        title.parent.insert(place + 1, html(_box(day)))


def _box(day: Day) -> str:
    return (
        f'<div class="run-box"><p>{said("site.run", RUN)}</p>'
        f"<pre data-copy>./roslings lab {day.number}</pre></div>"
    )


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_transform(ForgottenKeys)
    app.connect("doctree-resolved", add_box)
