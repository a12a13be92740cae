"""Two names that look alike: the letters by which they differ, marked."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator

from ros2_on_pip.markup import Markup, joined, prose, tag
from ros2_on_pip.near_names import SIMILAR

NAME = re.compile(r"(?<![\w/])(/[\w/]+|'[^'\n]{3,}'|\"[^\"\n]{3,}\")")


def marked(text: str, other: str) -> Markup:
    """`text` as prose; in each name that nearly stands in `other`, what differs is marked."""
    wanted = [name.strip("'\"") for name in NAME.findall(other)]
    parts = NAME.split(text)
    return joined(*(_named(p, wanted) if at % 2 else prose(p) for at, p in enumerate(parts)))


def _named(found: str, wanted: list[str]) -> Markup:
    bare = found.strip("'\"")
    near = difflib.get_close_matches(bare, wanted, n=1, cutoff=SIMILAR)
    if not near or near[0] == bare:
        return prose(found)
    quote = found[: found.index(bare)]
    return joined(quote, *_letters(bare, near[0]), quote)


def _letters(found: str, wanted: str) -> Iterator[Markup]:
    for kind, begin, end, _, _ in difflib.SequenceMatcher(None, found, wanted).get_opcodes():
        piece = joined(found[begin:end])
        yield piece if kind == "equal" or not piece else tag("mark", piece)
