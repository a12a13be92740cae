"""Tables that a screen reader can read: a column's head is never empty."""

from __future__ import annotations

from docutils import nodes
from sphinx.application import Sphinx

from ros2_on_pip.language import said


def name_columns(app: Sphinx, document: nodes.document) -> None:
    """Give an empty head a word that is read aloud and not seen."""
    for head in document.findall(nodes.thead):
        for entry in head.findall(nodes.entry):
            if not entry.astext().strip():
                spoken = nodes.inline(
                    "", said("site.table.value", "value"), classes=["only-read-aloud"]
                )
                entry += nodes.paragraph("", "", spoken)


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("doctree-read", name_columns)
