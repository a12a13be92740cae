"""HTML that an author wrote in a page: its texts are taken out for translators, as all others are.

Sphinx leaves such parts to themselves. Here each text between two tags is one of the page's texts,
and so is what is read aloud; the tags stay.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from html import unescape
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.transforms import SphinxTransform

BETWEEN = re.compile(r">([^<>]*[^\W\d_][^<>]*)<")
ALOUD = re.compile(r'\b(?:aria-label|alt|title|placeholder)="([^"]*[^\W\d_][^"]*)"')
NO_TEXT = re.compile(r"<(script|style|code|pre)\b.*?</\1>|<!--.*?-->", re.DOTALL)
BEFORE, AFTER = 5, 30
"""Priorities: Sphinx keeps the texts of a page at 10, and translates them at 20."""


class HtmlTexts(nodes.raw, addnodes.translatable):
    """Raw HTML while a page is translated."""

    def preserve_original_messages(self) -> None:
        """Called by Sphinx."""
        self["texts"] = list(texts_in(self.astext()))

    def extract_original_messages(self) -> Sequence[str]:
        """Called by Sphinx."""
        return tuple(self.get("texts", ()))

    def apply_translated_message(self, original_message: str, translated_message: str) -> None:
        """Called by Sphinx for each text."""
        text = translated(self.astext(), original_message, translated_message)
        self.children = [nodes.Text(text)]


def texts_in(html: str) -> Iterable[str]:
    """Each text once, on one line."""
    shown = NO_TEXT.sub("<x>", html)
    found = [*BETWEEN.findall(shown), *ALOUD.findall(shown)]
    return dict.fromkeys(" ".join(unescape(each).split()) for each in found)


def translated(html: str, original: str, text: str) -> str:
    """The HTML with a text in place of another; the blanks round it stay."""
    words = r"\s+".join(map(_as_written, original.split()))
    place = re.compile(rf'(>\s*|(?:aria-label|alt|title|placeholder)=")({words})(?=\s*<|")')
    return place.sub(lambda found: found[1] + text, html)


def _as_written(word: str) -> str:
    """A word of HTML, where some signs have names."""
    signs = {"&": "(?:&amp;|&)", "<": "&lt;", ">": "&gt;", '"': '(?:&quot;|")'}
    return "".join(signs.get(sign, re.escape(sign)) for sign in word)


class TakenOut(SphinxTransform):
    """Makes the HTML of a page's author translatable; ours has its texts by id, and no place."""

    default_priority = BEFORE

    def apply(self, **_: Any) -> None:
        """Each part."""
        for raw in list(self.document.findall(nodes.raw)):
            if raw.source and raw.get("format") == "html":
                part = HtmlTexts(raw.rawsource, raw.astext(), **raw.attributes)
                part.source, part.line = raw.source, raw.line
                raw.replace_self(part)


class PutBack(SphinxTransform):
    """What is written to a page is plain raw HTML again."""

    default_priority = AFTER

    def apply(self, **_: Any) -> None:
        """Each part, but where texts are taken out of pages."""
        if self.env.app.builder.name == "gettext":
            return
        for part in list(self.document.findall(HtmlTexts)):
            kept = {name: part[name] for name in part.attributes if name in RAW_HAS}
            raw = nodes.raw(part.rawsource, part.astext(), **kept)
            raw.source, raw.line = part.source, part.line
            part.replace_self(raw)


RAW_HAS = ("ids", "classes", "names", "dupnames", "format")


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_transform(TakenOut)
    app.add_transform(PutBack)
