"""The few words of a card that lead through the course: read without the models of a whole card.

Those take longer to make than all else that `./roslings status` does.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

DAY = r"^[0-9]{2}-[a-z0-9-]+$"
PACKAGE = r"^[a-z][a-z0-9_]*$"


@dataclass(frozen=True)
class Outline:
    """What a lab is called, when it comes, and which package it asks for; as in `Card`."""

    title: str
    day: str
    needs: tuple[str, ...]
    package: str


def outline_in(tree: Any) -> Outline | None:
    """The outline in what YAML reads from a card; None where a card would not be like this."""
    try:
        found = Outline(tree["title"], tree["day"], tuple(tree.get("needs") or ()), tree["package"])
    except (AttributeError, KeyError, TypeError):
        return None
    return found if _holds(found) else None


def _holds(found: Outline) -> bool:
    texts = (found.title, found.day, found.package, *found.needs)
    return all(isinstance(text, str) for text in texts) and bool(
        re.match(DAY, found.day) and re.match(PACKAGE, found.package)
    )
