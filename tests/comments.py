"""What is said in plain English beside the code: comments, and docstrings."""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby

from roslings_learn.lessons.rules.prose import ITEM, blocks_of, sentences

PROSE = ("paragraph", "item")
MARKS = re.compile(r">>>|---|===")
COLUMNS = re.compile(r"\S {2,}\S")
"""A line of a table without rules, or of code with a comment at its end."""
SOURCE = re.compile(r"Sources?: ")
"""What begins so lists titles and addresses, and is no sentence."""


@dataclass(frozen=True)
class Sentence:
    """One, and the line on which its paragraph begins."""

    line: int
    text: str


def sentences_of(code: str) -> Iterator[Sentence]:
    """All that a Python file says."""
    yield from _behind_hashes(code)
    yield from _docstrings(code)


def _behind_hashes(code: str) -> Iterator[Sentence]:
    """Comments on lines of their own, one below the other, are one text."""
    tokens = tokenize.generate_tokens(io.StringIO(code).readline)
    found = [token for token in tokens if token.type == tokenize.COMMENT]
    for _, numbered in groupby(enumerate(found), key=_text_of):
        lines = [token for _, token in numbered]
        said = (token.string.removeprefix("#").removeprefix(" ") for token in lines)
        yield from _said(lines[0].start[0], "\n".join(said))


def _text_of(numbered: tuple[int, tokenize.TokenInfo]) -> tuple[bool, int]:
    """The same for all lines of one text; a comment behind code is a text by itself."""
    number, token = numbered
    alone = token.line.lstrip().startswith("#")
    return alone, token.start[0] - number if alone else number


def _docstrings(code: str) -> Iterator[Sentence]:
    """Of modules, classes and functions, and those below what a class or a module holds."""
    for node in ast.walk(ast.parse(code)):
        match node:
            case ast.Expr(value=ast.Constant(value=str(text))):
                margin = " " * node.col_offset
                lines = (line.removeprefix(margin) for line in text.split("\n"))
                yield from _said(node.lineno, "\n".join(lines))


def _said(line: int, text: str) -> Iterator[Sentence]:
    for block in blocks_of("\n".join(_without_code(text))):
        if block.kind in PROSE:
            for sentence in sentences(block.text):
                if not SOURCE.match(sentence):
                    yield Sentence(line + block.line - 1, sentence)


def _without_code(text: str) -> Iterator[str]:
    """Its lines, empty where they are code or a table. What goes on below an item is no code."""
    in_item = False
    for line in text.split("\n"):
        indented = line.startswith(" ")
        in_item = in_item if indented else bool(ITEM.match(line))
        code = (indented and not in_item) or MARKS.match(line) or COLUMNS.search(line)
        yield "" if code else line
