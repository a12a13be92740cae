"""Looks for English that nobody asked for by an id: words that stay plain in the false language."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from html.parser import HTMLParser

from ros2_on_pip.false_language import plain_words

Place = tuple[str, str]
"""A text that people read, and where it stands."""
QUOTED = re.compile(r"(?<!\w)'[^'\n]*'(?!\w)|\"[^\"\n]*\"")
"""What somebody's program said, or what is typed."""
ANCHOR = re.compile(r"days/[\w#-]+")
READ_ALOUD = ("aria-label", "alt", "title", "placeholder")
NOT_READ = ("code", "pre", "script", "style", "kbd")
MARK = "mark"
"""A piece of a name, whose letters differ: the text goes on through it."""
VOID = ("meta", "br", "img", "input", "line", "rect", "ellipse", "path", "use", "source", "link")
NAMES = frozenset({"SIGINT"})
"""No language has other words for them."""


def words_of(text: str) -> frozenset[str]:
    """All words of a text, as they are written."""
    return frozenset(re.findall(r"[^\W\d_]+", text))


def plain(places: Iterable[Place], known: frozenset[str] = frozenset()) -> list[str]:
    """A line for each plain word: the word, its text, and where that stands.

    `known` are words that are the same in each language: names, and what a card says.
    """
    return [
        f"{word!r} in {' '.join(text.split())[:90]!r} ({where})"
        for text, where in places
        for word in plain_words(ANCHOR.sub("", QUOTED.sub("", text)))
        if word not in known | NAMES
    ]


def read_in(page: str) -> Iterator[Place]:
    """What people read in a page's HTML, or have read to them, without code."""
    reader = _Reader()
    reader.feed(page)
    yield from reader.found


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.found: list[Place] = []
        self._inside: list[str] = []
        self._text = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == MARK:
            return
        self._end_text()
        given = dict(attrs)
        if tag not in VOID:
            self._inside.append("hint" if given.get("class") == "hint" else tag)
        for name in READ_ALOUD:
            if text := given.get(name):
                self.found.append((text, f"{self._place()} {name}"))

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """A drawing's own tags are closed as XML wants it."""

    def handle_endtag(self, tag: str) -> None:
        if tag == MARK:
            return
        self._end_text()
        if tag not in VOID:
            self._inside.pop()

    def handle_data(self, data: str) -> None:
        self._text += data

    def _end_text(self) -> None:
        if self._text.strip() and not set(self._inside) & set(NOT_READ):
            self.found.append((self._text, self._place()))
        self._text = ""

    def _place(self) -> str:
        return " > ".join(self._inside[-3:])
