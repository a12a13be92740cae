"""Code in few tags: what looks the same on the page is the same in its markup.

Pygments marks every name, bracket and space. Most of them have the colour of plain text, in the
light style and in the dark one; a lesson then has twice as many bytes of marks as of code. And
Sphinx wraps each word of `code in a line` once more, names each cell, and each part of it, a
container, and tells a cell's tags: the theme uses none of it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache
from typing import Any

from pygments.formatters import HtmlFormatter
from pygments.style import Style
from pygments.styles import get_style_by_name
from pygments.token import STANDARD_TYPES, Generic, Operator, Text, _TokenType
from sphinx.application import Sphinx
from sphinx.highlighting import PygmentsBridge

CODE_IN_A_LINE = re.compile(r'<code class="docutils literal notranslate">(.*?)</code>', re.DOTALL)
CELL = re.compile(r'<div class="cell(?: tag_[\w-]+)* docutils container">')
PART_OF_A_CELL = re.compile(r'<div class="(cell_(?:in|out)put) docutils container">')
WRAPPED = re.compile(r'<span class="pre">([^<]*)</span>')
Look = tuple[tuple[tuple[str, Any], ...], ...]
"""How a kind of token looks, in each style."""


class FewTags(HtmlFormatter[str]):
    """Marks only what has a look of its own."""

    styles: tuple[type[Style], ...] = ()

    def format_unencoded(self, tokensource: Iterable[tuple[_TokenType, str]], outfile: Any) -> None:
        """Called by Pygments."""
        super().format_unencoded(self._plainer(tokensource), outfile)

    def _plainer(
        self, tokens: Iterable[tuple[_TokenType, str]]
    ) -> Iterator[tuple[_TokenType, str]]:
        for kind, text in tokens:
            yield plainest(kind, self.styles), text


@cache
def plainest(kind: _TokenType, styles: tuple[type[Style], ...]) -> _TokenType:
    """The most general kind of token that looks like this one; plain text, where it does.

    Prompts keep their kind (they are not copied), and so does what a terminal coloured. Signs such
    as the dot are told by their form, and there are more of them than of all else: no colour.
    """
    if kind is Operator:
        return Text
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


def unwrap(app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
    """Leave out the tags that no style looks at."""
    body = context.get("body", "").replace("<pre><span></span>", "<pre>")
    body = CELL.sub('<div class="cell">', body)
    body = PART_OF_A_CELL.sub(r'<div class="\1">', body)
    context["body"] = CODE_IN_A_LINE.sub(_code, body)


def _code(found: re.Match[str]) -> str:
    inside = WRAPPED.sub(r"\1", found[1])
    return f'<code class="literal notranslate">{inside}</code>'


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    PygmentsBridge.html_formatter = FewTags
    app.connect("builder-inited", choose_styles)
    app.connect("html-page-context", unwrap)
