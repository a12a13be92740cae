"""HTML that is safe by how it is made: a text is escaped unless `tag` itself wrote it."""

from __future__ import annotations

import html
import re
from string import Formatter

from ros2_on_pip.language import template
from ros2_on_pip.safe_text import harmless

_CODE = re.compile(r"`([^`\n]+)`")
VOID = frozenset({"meta", "line", "rect", "ellipse", "path", "br", "img", "input"})
HTML_VOID = frozenset({"meta", "br", "img", "input"})
"""The others are SVG's, and are closed as XML wants it."""

Attribute = str | float | None


class Markup(str):
    """Text that is HTML already. Made by `tag` and `joined` alone."""

    __slots__ = ()


def tag(name: str, /, *inside: str, **attributes: Attribute) -> Markup:
    """One element. A name that Python or HTML spells otherwise: `class_`, `aria_label`.

    An attribute of None is left out; an empty one stands without a value.
    """
    words = "".join(_attribute(key, value) for key, value in attributes.items())
    if name in VOID:
        return Markup(f"<{name}{words}>" if name in HTML_VOID else f"<{name}{words}/>")
    return Markup(f"<{name}{words}>{joined(*inside)}</{name}>")


def joined(*parts: str) -> Markup:
    """Several pieces in a row."""
    return Markup("".join(part if isinstance(part, Markup) else _escaped(part) for part in parts))


def prose(text: str) -> Markup:
    """A sentence, with what stands between backquotes as code."""
    parts = _CODE.split(text)
    return joined(*(tag("code", p) if index % 2 else p for index, p in enumerate(parts)))


def told(id: str, english: str, /, **fields: str) -> Markup:
    """The text of this id in the language that is asked for; a field may be an element.

    So each language has its own order of words round what is code on a page.
    """
    parts = Formatter().parse(template(id, english))
    filled = {**fields, "": ""}  # behind the last field there may be text, and no other field
    return joined(*(part for text, name, _, _ in parts for part in (text, filled[name or ""])))


def _attribute(key: str, value: Attribute) -> str:
    name = key.rstrip("_").replace("_", "-")
    if value is None:
        return ""
    text = _number(value) if isinstance(value, float) else str(value)
    return f' {name}="{_escaped(text)}"' if text else f" {name}"


def _number(value: float) -> str:
    """A length, without digits that nobody sees."""
    return f"{value:.1f}".removesuffix(".0")


def _escaped(text: str) -> str:
    """`harmless` takes what steers a terminal or a reader's eye, and what no page may hold."""
    return html.escape(harmless(text, keep_newlines=True))
