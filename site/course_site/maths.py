"""Formulas: none. The usual renderer loads a script from another host, which a lab may not have."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util import logging

log = logging.getLogger(__name__)


def refuse(translator: Any, node: nodes.Element) -> None:
    """Say how to write it instead; the build then fails."""
    log.warning("The site shows no formulas. Write it in words or as code.", location=node)
    raise nodes.SkipNode


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_html_math_renderer("none", (refuse, None), (refuse, None))
