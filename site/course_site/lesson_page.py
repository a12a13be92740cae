"""A lesson as a page to read: its first screen, and boxes for what the reader is asked to do.

In JupyterLab a lesson is cells. Here nothing runs, so the page shows what it is about first (goal,
level, time and need as a card, then the drawing that `days/path.yaml` names), folds the imports,
and marks what to guess ("Before you run") and what to change ("Your turn"). What a cell printed is
folded where the reader guesses first.
"""

from __future__ import annotations

from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.transforms import SphinxTransform
from sphinx.util import logging

from course_site.course import BEFORE_TRANSLATION, html
from course_site.run_box import day_of
from ros2_on_pip.language import language, said

log = logging.getLogger(__name__)

GUESS = "Before you run"
YOUR_TURN = '<div class="your-turn"><p class="your-turn-title">{title}</p>'
END = "</div>"


def shape(app: Sphinx, document: nodes.document) -> None:
    """Give a lesson its form; other pages stay as they are."""
    day = day_of(app.config, app.env.docname)
    if day is None:
        return
    card = _card(document)
    if card is not None and day.picture:
        _show_first(document, day.picture, card)
    for cell in list(document.findall(nodes.container)):
        _mark_cell(cell)


def _card(document: nodes.document) -> nodes.Element | None:
    """The list below the title, where each item begins with what it is about."""
    found = next(iter(document.findall(nodes.bullet_list)), None)
    if found is None or not all(_label(item) for item in found.children):
        return None
    found["classes"].append("day-card")
    return found


def _label(block: nodes.Node) -> str:
    """The bold words that a block begins with."""
    texts = (text for text in block.findall(nodes.Text) if text.astext())
    first = next(texts, None)
    bold = first is not None and isinstance(first.parent, nodes.strong)
    return first.astext() if first is not None and bold else ""


def _show_first(document: nodes.document, name: str, card: nodes.Element) -> None:
    """Put the drawing below the card. It stands there once, wherever the lesson has it."""
    names = (f"/{name}", f"/{in_language(name)}")
    found = [image for image in document.findall(nodes.image) if image["uri"].endswith(names)]
    if not found:
        log.warning("The lesson has no picture '%s'. Mend: path.yaml.", name, location=document)
        return
    holder = found[0].parent
    holder.parent.remove(holder)
    card.parent.insert(_place_below(card), holder)


def in_language(name: str) -> str:
    """What Sphinx takes for a drawing where it is there: `rover.de.svg` for `rover.svg`."""
    stem, _, ending = name.rpartition(".")
    return f"{stem}.{language()}.{ending}"


def _place_below(card: nodes.Element) -> int:
    """After the card, and after the command that its last item asks for, where there is one."""
    blocks = card.parent.children
    place = card.parent.index(card) + 1
    while place < len(blocks) and isinstance(blocks[place], nodes.literal_block):
        place += 1
    return place


class Guesses(SphinxTransform):
    """Marks what the reader guesses: by its English, before it is translated."""

    default_priority = BEFORE_TRANSLATION

    def apply(self, **_: Any) -> None:
        """Each paragraph of a lesson that begins so."""
        if day_of(self.config, self.env.docname) is None:
            return
        for paragraph in self.document.findall(nodes.paragraph):
            if _label(paragraph).startswith(GUESS):
                paragraph["classes"].append("guess")


def _mark_cell(cell: nodes.container) -> None:
    """By the tags that the notebook gives it."""
    tags = cell.get("classes", ())
    if "tag_imports" in tags:
        _between(
            cell, _folded(said("site.lesson.imports", "The imports of this page")), "</details>"
        )
    elif "tag_change" in tags:
        title = said("site.lesson.your_turn", "Your turn")
        _between(cell, YOUR_TURN.format(title=title), END)
        before = said("site.lesson.before", "What it says before you change it")
        _fold_outputs(cell, before)
    elif _follows_a_guess(cell):
        _fold_outputs(cell, said("site.lesson.guess", "What it prints: guess first"))


def _follows_a_guess(cell: nodes.container) -> bool:
    """What stands before it asks what it will do."""
    place = cell.parent.index(cell)
    before = cell.parent.children[place - 1] if place else None
    return isinstance(before, nodes.paragraph) and "guess" in before["classes"]


def _fold_outputs(cell: nodes.container, summary: str) -> None:
    for output in cell.children[1:]:
        _between(output, _folded(summary), "</details>")


def _folded(summary: str) -> str:
    return f'<details class="folded"><summary>{summary}</summary>'


def _between(node: nodes.Node, before: str, after: str) -> None:
    place = node.parent.index(node)
    node.parent.insert(place + 1, html(after))
    node.parent.insert(place, html(before))


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_transform(Guesses)
    app.connect("doctree-read", shape, priority=600)  # after the pictures got their paths
