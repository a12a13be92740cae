"""What a card says about gales, and its row in task.md."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

from pydantic import Field

from roslings.capability import Row, Words
from roslings.course.contract import NodeWords
from roslings.course.kinds import Kind


class GaleWords(NodeWords):
    """What a card may say of a node."""

    warns_above_m_s: Annotated[float | None, Kind.EDGE] = Field(default=None, gt=0)


def rows(node: GaleWords) -> Iterable[Row]:
    """The wind that is a gale."""
    if node.warns_above_m_s:
        yield "warns", f"of wind above {node.warns_above_m_s:g} m/s"


WORDS = Words(node=GaleWords, settings=rows)
