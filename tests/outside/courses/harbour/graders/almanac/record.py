"""What was seen of the wind."""

from __future__ import annotations

from pydantic import Field

from roslings.record import Columns, PartSeen


class WindSeen(PartSeen):
    """All that was blown in an experiment."""

    NAME = "almanac"

    speeds_m_s: Columns[float] = Field(default_factory=list)
