"""Rules on text alternatives: who does not see a drawing must not be told of another one.

What a text alternative names and a machine can look up stands in the drawing's own words: its
texts, its title and its description.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as Xml
from collections.abc import Iterable
from pathlib import Path

COUNTS = ("two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
THINGS = frozenset(
    {
        "bell",
        "clock",
        "cloud",
        "counter",
        "desk",
        "dial",
        "door",
        "gate",
        "glass",
        "key",
        "ladder",
        "lock",
        "locked",
        "scale",
        "sign",
        "stair",
        "switch",
        "table",
        "tap",
        "wall",
        "wheel",
        "window",
    }
)
"""What a drawing shows or does not: nobody says it by the way."""
SHOWN = THINGS | frozenset(COUNTS)
WORD = re.compile(r"[a-z]+")
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?!\w)")
NAME = re.compile(
    r"(?<![\w./])(?:/[a-z]\w*(?:/\w+)*"  # of a node, a topic
    r"|\w+_\w+|[A-Z]{4,}"  # of a parameter, a policy
    r"|\w+\.(?:py|xml|cfg|bash|yaml))"  # of a file
)


def untold(alternative: str, drawing: Path) -> list[str]:
    """Numbers, names and things of a text alternative that the drawing does not tell."""
    own = own_words(drawing)
    numbers = {float(digits) for digits in re.findall(r"\d+(?:\.\d+)?", own)}
    joined = own.lower().replace(" ", "")  # a long name may stand in two lines
    told = _with_counts(WORD.findall(own.lower()), numbers)
    return [
        *(each for each in NUMBER.findall(alternative) if float(each) not in numbers),
        *(each for each in NAME.findall(alternative) if each.lower() not in joined),
        *(
            each
            for each in WORD.findall(alternative.lower())
            if each in SHOWN and not {each, f"{each}s"} & told
        ),
    ]


def _with_counts(words: Iterable[str], numbers: set[float]) -> set[str]:
    """The words, and those numbers that may be said in a word, too."""
    return {*words, *(word for value, word in enumerate(COUNTS, 2) if value in numbers)}


def own_words(drawing: Path) -> str:
    """All that a drawing says; nothing where it is no XML, of which another rule tells."""
    try:
        parts = list(Xml.fromstring(drawing.read_text("utf-8")).iter())
    except Xml.ParseError:
        return ""
    said = [part for part in parts if part.tag.endswith(("}text", "}title", "}desc"))]
    return " ".join("".join(part.itertext()) for part in said)
