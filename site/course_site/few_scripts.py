"""Sphinx's scripts for searching, on the search page only.

Elsewhere they only mark the words that the reader came with from a search: `page.js` loads them
then.
"""

from __future__ import annotations

from typing import Any

from sphinx.application import Sphinx

SEARCH_PAGE = "search"
OF_THE_SEARCH = ("documentation_options.js", "doctools.js", "sphinx_highlight.js")


def keep_needed(
    app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: Any
) -> None:
    """Take them from all other pages."""
    if page != SEARCH_PAGE:
        scripts = context["script_files"]
        context["script_files"] = [each for each in scripts if not _of_the_search(each)]


def _of_the_search(script: Any) -> bool:
    return str(script.filename or "").endswith(OF_THE_SEARCH)


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("html-page-context", keep_needed, priority=950)  # after all have added theirs
