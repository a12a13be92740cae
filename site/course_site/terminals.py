"""Drawings of terminals are dark by themselves: a dark page does not turn their colours round."""

from __future__ import annotations

from pathlib import Path

from docutils import nodes
from sphinx.application import Sphinx

MARK = 'class="terminal"'
"""Stands in the first tag of such a drawing."""
HEAD = 500


def keep_colours(app: Sphinx, document: nodes.document) -> None:
    """Say it in the markup of each: a style sheet cannot look into a picture."""
    for image in document.findall(nodes.image):
        file = Path(app.srcdir, image["uri"])
        if file.suffix == ".svg" and file.is_file() and MARK in file.read_text("utf-8")[:HEAD]:
            image["classes"].append("terminal")


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("doctree-read", keep_colours, priority=600)  # after the pictures got their paths
