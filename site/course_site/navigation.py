"""The side bar: the theme calls its captions headings without a level, which no reader can use."""

from __future__ import annotations

from typing import Any

from sphinx.application import Sphinx


def mend_captions(app: Sphinx, page: str, template: str, context: Any, doctree: Any) -> None:
    """Leave the captions plain text: they name lists, and the page has headings of its own."""
    tree = context.get("furo_navigation_tree", "")
    context["furo_navigation_tree"] = tree.replace(' role="heading"', "")


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("html-page-context", mend_captions, priority=900)  # after the theme's own
