"""Coloured code in few tags: what looks the same on the page is the same in its markup.

Pygments marks every name, bracket and space. Most of them have the colour of plain text, in the
light style and in the dark one; a lesson then has twice as many bytes of marks as of code.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import Any

from pygments.formatters import HtmlFormatter
from pygments.style import Style
from pygments.styles import get_style_by_name
from pygments.token import STANDARD_TYPES, Generic, Text, _TokenType
from sphinx.application import Sphinx
from sphinx.highlighting import PygmentsBridge

Look = tuple[tuple[tuple[str, Any], ...], ...]
"""How a kind of token looks, in each style."""


class FewTags(HtmlFormatter[str]):
    """Marks only what has a look of its own."""

    styles: tuple[type[Style], ...] = ()

    def format_unencoded(
        self, tokensource: Iterable[tuple[_TokenType, str]], outfile: Any
    ) -> None:
        """Called by Pygments."""
        super().format_unencoded(self._plainer(tokensource), outfile)

    def _plainer(
        self, tokens: Iterable[tuple[_TokenType, str]]
    ) -> Iterator[tuple[_TokenType, str]]:
        for kind, text in tokens:
            yield plainest(kind, self.styles), text


@lru_cache(maxsize=None)
def plainest(kind: _TokenType, styles: tuple[type[Style], ...]) -> _TokenType:
    """The most general kind of token that looks like this one; plain text, where it does.

    Prompts keep their kind (they are not copied), and so does what a terminal coloured.
    """
    if kind not in STANDARD_TYPES or kind in Generic:
        return kind
    wanted = _look(kind, styles)
    alike = (each for each in (Text, *kind.split()[1:]) if _look(each, styles) == wanted)
    return next(alike)


def _look(kind: _TokenType, styles: tuple[type[Style], ...]) -> Look:
    return tuple(tuple(style.style_for_token(kind).items()) for style in styles)


def choose_styles(app: Sphinx) -> None:
    """The page has both, and the reader chooses."""
    if app.builder.format == "html":  # else there is no theme, and no dark style
        names = (app.config.pygments_style, app.config.pygments_dark_style)
        FewTags.styles = tuple(get_style_by_name(name) for name in names)


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    PygmentsBridge.html_formatter = FewTags
    app.connect("builder-inited", choose_styles)
