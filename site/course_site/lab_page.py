"""A lab as a page to read: what will move, then the steps; the card below them, folded by node.

`task.md` has the card first, as a contract has it, and whoever reads the file has all of it. On a
page it would be a wall of tables before the first step.
"""

from __future__ import annotations

import re
from html import escape

from docutils import nodes
from sphinx.application import Sphinx

from course_site.course import html
from ros2_on_pip.language import said

PAGE = re.compile(r"labs/(?!index$)[^/]+")
CARD, STEPS, POINTS = "the-card", "the-steps", "the-points"
WHERE = (
    'Each name and number that counts stands in <a href="#the-card">the card</a>, below the steps.'
)


def shape(app: Sphinx, document: nodes.document) -> None:
    """Give a lab's page its form; other pages stay as they are."""
    if not PAGE.fullmatch(app.env.docname):
        return
    card, steps, points = (_section(document, name) for name in (CARD, STEPS, POINTS))
    if card is None or steps is None:
        return
    parent = card.parent
    parent.remove(card)
    steps.insert(1, html(f'<p class="note-box">{said("site.lab.where", WHERE)}</p>'))
    place = parent.index(points) if points is not None else len(parent)
    parent.insert(place, card)
    for table in list(card.findall(nodes.table)):
        _fold(table)


def _section(document: nodes.document, name: str) -> nodes.section | None:
    found = (each for each in document.findall(nodes.section) if name in each["ids"])
    return next(found, None)


def _fold(table: nodes.table) -> None:
    """Behind its title, which is the head of its first column where the second has none."""
    heads = [entry.astext() for each in table.findall(nodes.thead) for entry in _entries(each)]
    if len(heads) != 2 or heads[1].strip():
        return
    rows = sum(1 for body in table.findall(nodes.tbody) for _ in body.findall(nodes.row))
    place = table.parent.index(table)
    summary = escape(said("site.lab.lines", "{title}: {count} lines", title=heads[0], count=rows))
    table.parent.insert(place + 1, html("</details>"))
    opening = f'<details class="folded of-card"><summary>{summary}</summary>'
    table.parent.insert(place, html(opening))


def _entries(part: nodes.Element) -> list[nodes.entry]:
    return list(part.findall(nodes.entry))


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("doctree-read", shape, priority=300)  # before the page's contents are listed
