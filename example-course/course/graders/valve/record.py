"""What was seen of managed nodes: each transition that was asked for, and where it led."""

from __future__ import annotations

from pydantic import Field

from roslings.record import Columns, PartSeen, Record


class StepSeen(Record):
    """One transition that was asked for."""

    node: str = Field(description="Full name of the node that was asked")
    transition: str
    accepted: bool | None = Field(default=None, description="None where no answer came")
    state: str | None = Field(default=None, description="Afterwards; None where no answer came")


class LifecycleSeen(PartSeen):
    """All that was seen of managed nodes in an experiment."""

    NAME = "lifecycle"

    steps: Columns[StepSeen] = Field(default_factory=list)
