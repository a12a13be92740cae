"""What was seen of quality of service: what those get who come late."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from roslings.record import Columns, PartSeen, Record


class JoinSeen(Record):
    """What a subscription got that came late to a latched topic."""

    after: str = Field(description="What was done before, in words")
    wanted: Any = Field(description="What the last message should say")
    said: int = Field(description="So many messages there should be so far")
    heard: list[Any] = Field(default_factory=list, description="In their order")
    matched: bool = True


class QosSeen(PartSeen):
    """All that was seen of it in an experiment."""

    NAME = "qos"

    v: int = 2
    joins: Columns[JoinSeen] = Field(default_factory=list)
