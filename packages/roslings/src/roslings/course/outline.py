"""The few words of a card that lead through the course: read without the models of a whole card.

Those take longer to make than all else that `./roslings status` does. It answers before anything is
installed, too: so what is written as usual is read without YAML.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

_NAME = "[a-z][a-z0-9-]*"
_END = r"[ \t]*(?:[ \t]#.*)?$"
TEXT = re.compile(
    rf"^(title|day|package): ((?:\d\d-)?[A-Za-z](?:[^:#\n]*[^:#\s])?){_END}", re.MULTILINE
)
"""A line of a card that has one meaning in YAML, or none: a text of plain letters."""
NAMES = re.compile(rf"^needs: \[({_NAME}(?:, *{_NAME})*)\]{_END}", re.MULTILINE)
"""The same of a list of names."""
NO_TEXTS = frozenset({"y", "n", "yes", "no", "on", "off", "true", "false", "null"})
"""Letters that are no text in YAML."""
WORDS = re.compile(r"^(?:title|day|needs|package)\b", re.MULTILINE)
DAY = r"^[0-9]{2}-[a-z0-9-]+$"
PACKAGE = r"^[a-z][a-z0-9_]*$"


@dataclass(frozen=True)
class LabOutline:
    """What a lab is called, when it comes, and which package it asks for; as in `Card`."""

    title: str
    day: str
    needs: tuple[str, ...]
    package: str


def outline_as_written(card: str) -> LabOutline | None:
    """The outline in the lines of a card; None where one of them is not written as usual."""
    texts, lists = TEXT.findall(card), NAMES.findall(card)
    found, needs = dict(texts), [name for names in lists for name in re.split(", *", names)]
    if len(WORDS.findall(card)) != len(found) + len(lists) or len(found) < 3 or len(lists) > 1:
        return None
    if NO_TEXTS & {text.lower() for text in (*found.values(), *needs)}:
        return None
    outline = LabOutline(found["title"], found["day"], tuple(needs), found["package"])
    return outline if _holds(outline) else None


def outline_in(tree: Any) -> LabOutline | None:
    """The outline in what YAML reads from a card; None where a card would not be like this."""
    try:
        found = LabOutline(
            tree["title"], tree["day"], tuple(tree.get("needs") or ()), tree["package"]
        )
    except (AttributeError, KeyError, TypeError):
        return None
    return found if _holds(found) else None


def _holds(found: LabOutline) -> bool:
    texts = (found.title, found.day, found.package, *found.needs)
    return all(isinstance(text, str) for text in texts) and bool(
        re.match(DAY, found.day) and re.match(PACKAGE, found.package)
    )
