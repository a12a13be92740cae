"""Text from a student's node, made safe to show: no control characters, no broken lines."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator

# Characters that steer a terminal or a reader's eye instead of being seen: control characters,
# halves of surrogate pairs, line and paragraph separators.
_UNSEEN = frozenset({"Cc", "Cs", "Zl", "Zp"})
# Marks that turn the direction of the text after them (Unicode Standard Annex 9).
_TURNING = frozenset("\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
# What we write ourselves, for an encoding that lacks it.
_PLAINER = {
    0x2026: "...",
    0x2013: "-",
    0x2014: "-",
    0x2018: "'",
    0x2019: "'",
    0x201C: '"',
    0x201D: '"',
    0x2192: "->",
    0xB1: "+-",
}

Measure = Callable[[str], int]


def harmless(text: str, *, keep_newlines: bool = False) -> str:
    """`text` with everything that could steer a terminal shown as an escape, e.g. `\\x1b`.

    Tabs become spaces. Bytes that were no UTF-8 (Python's surrogateescape) show as `\\xff`.
    """
    return "".join(
        char if keep_newlines and char == "\n" else _shown(char) for char in text.expandtabs(4)
    )


def _shown(char: str) -> str:
    if "\udc80" <= char <= "\udcff":
        return f"\\x{ord(char) - 0xDC00:02x}"
    if unicodedata.category(char) in _UNSEEN or char in _TURNING:
        return char.encode("unicode_escape").decode("ascii")
    return char


def can_show(text: str, encoding: str) -> bool:
    """Whether `encoding` has every character of `text`."""
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        return False
    return True


def in_encoding(text: str, encoding: str) -> str:
    """`text` with what `encoding` lacks written in plainer characters, or as escapes."""
    if can_show(text, encoding):
        return text
    plainer = text.translate(_PLAINER)
    return plainer.encode(encoding, "backslashreplace").decode(encoding)


def wrapped(text: str, width: int, measure: Measure = len) -> list[str]:
    """Lines of at most `width` cells; a new line in `text` stays one.

    Long names break after `/` or `_`. `measure` gives a string's width in cells.
    """
    return [
        line
        for paragraph in text.splitlines() or [""]
        for line in _wrapped_paragraph(paragraph, width, measure)
    ]


def _wrapped_paragraph(paragraph: str, width: int, measure: Measure) -> list[str]:
    if measure(paragraph) <= width:
        return [paragraph.rstrip()]
    words = paragraph.split()
    indent = paragraph[: len(paragraph) - len(paragraph.lstrip())][: width // 2]
    return [indent + line for line in filled(words, width - len(indent), measure)]


def filled(words: Iterable[str], width: int, measure: Measure = len, joint: str = " ") -> list[str]:
    """`words` in as few lines as fit; a line break comes only between words that fit a line."""
    lines = [""]
    for word in words:
        longer = f"{lines[-1]}{joint if lines[-1] else ''}{word}"
        if measure(longer + joint.rstrip()) <= width:
            lines[-1] = longer
        else:
            lines[-1] += joint.rstrip() if lines[-1] else ""
            lines.extend(_pieces(word, width, measure))
    return [line for line in lines if line] or [""]


def _pieces(word: str, width: int, measure: Measure) -> Iterator[str]:
    """One word in lines: after a `/` or `_` where there is one, else where the line is full."""
    line = ""
    for part in re.findall(r"[/_]*[^/_]+[/_]*|[/_]+", word):
        if line and measure(line + part) > width:
            yield line
            line = ""
        line += part
        while measure(line) > width:
            cut = _fitting(line, width, measure)
            yield line[:cut]
            line = line[cut:]
    yield line


def _fitting(text: str, width: int, measure: Measure) -> int:
    """How many of the first characters fit; at least one, so that a loop comes to its end."""
    cut = min(len(text), max(width, 1))
    while cut > 1 and measure(text[:cut]) > width:
        cut -= 1
    return cut


def cut_to(text: str, width: int, measure: Measure = len, mark: str = "…") -> str:
    """`text` on one line of at most `width` cells, with `mark` where its end is missing."""
    if measure(text) <= width:
        return text
    return text[: _fitting(text, width - measure(mark), measure)].rstrip() + mark
