"""Markdown as far as the rules need it: blocks with their lines, sentences with their lengths."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

Kind = Literal["heading", "paragraph", "item", "table", "code"]
FENCE = re.compile(r"\s*(```+|~~~+)\s*(.*)$")
HEADING = re.compile(r"(#{1,6})\s+(.*?)\s*#*$")
ITEM = re.compile(r"\s*(?:[-*+]|\d+[.)])\s+(.*)$")
IMAGE = re.compile(r"!\[([^\]]*)\]\(([^)\s]*)[^)]*\)")
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^)\s]*)[^)]*\)")
CODE = re.compile(r"`+[^`]+`+")
SHORT = re.compile(r"\b(e\.g\.|i\.e\.|etc\.|vs\.)", re.IGNORECASE)


@dataclass(frozen=True)
class Block:
    """A paragraph, an item of a list, a heading, a row of a table, or code between fences."""

    kind: Kind
    line: int
    text: str
    level: int = 0
    """Of a heading, 1 to 6."""
    language: str = ""
    """Of code."""


def blocks_of(text: str) -> Iterator[Block]:
    """The blocks of a Markdown text, in order. Comments are left out."""
    return _joined(_lines(text))


def _lines(text: str) -> Iterator[Block | None]:
    """One block a line; None for an empty line, and code whole."""
    lines = enumerate(_without_comments(text).splitlines(), 1)
    for number, line in lines:
        fence = FENCE.match(line)
        if fence:
            inside = []
            for _, later in lines:
                if later.strip().startswith(fence[1]):
                    break
                inside.append(later)
            yield Block("code", number, "\n".join(inside), language=fence[2].strip())
        else:
            yield _line(number, line)


def _line(number: int, line: str) -> Block | None:
    if not line.strip():
        return None
    if heading := HEADING.match(line):
        return Block("heading", number, heading[2], level=len(heading[1]))
    if line.lstrip().startswith("|"):
        return Block("table", number, line.strip())
    if item := ITEM.match(line):
        return Block("item", number, item[1])
    return Block("paragraph", number, line.strip().removeprefix(">").strip())


def _joined(lines: Iterator[Block | None]) -> Iterator[Block]:
    """Lines that go on are one block with the line before."""
    open_: Block | None = None
    for line in lines:
        if open_ and line and line.kind == "paragraph" and open_.kind in ("paragraph", "item"):
            open_ = replace(open_, text=f"{open_.text} {line.text}")
            continue
        if open_:
            yield open_
        open_ = line
    if open_:
        yield open_


def _without_comments(text: str) -> str:
    return re.sub(r"<!--.*?-->", lambda found: "\n" * found[0].count("\n"), text, flags=re.DOTALL)


def plain(text: str) -> str:
    """What a reader reads: links as their words, code as one word, no marks."""
    text = CODE.sub("Code", IMAGE.sub("", text))
    return re.sub(r"\*\*|__|(?<!\w)[*_]|[*_](?!\w)", "", LINK.sub(r"\1", text)).strip()


def sentences(text: str) -> list[str]:
    """The sentences of a block. `e.g.` does not end one."""
    held = SHORT.sub(lambda found: found[0].replace(".", "\0"), plain(text))
    parts = re.split(r"(?<=[.!?])[\"')\]]*\s+(?=[\"'(]?[A-Z0-9/~])", held)
    return [part.replace("\0", ".").strip() for part in parts if part.strip()]


def words(text: str) -> int:
    """How many words a text has."""
    return sum(any(sign.isalnum() for sign in word) for word in text.split())


def slug(heading: str) -> str:
    """The anchor of a heading: `No waiting in a callback` is `no-waiting-in-a-callback`."""
    bare = plain(CODE.sub(lambda found: found[0].strip("`"), heading))
    return re.sub(r"[^\w\- ]", "", bare.lower()).replace(" ", "-")
