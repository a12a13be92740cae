"""What was seen of quality of service in time: stops of a guard, late joiners, two computers."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from roslings.record import Columns, PartSeen, Record


class MoveSeen(Record):
    """One message to the motors."""

    at_ns: int
    fields: dict[str, float] = Field(
        description="By names with dots, e.g. `linear.x`; those that are zero are left out"
    )


class DriveSeen(Record):
    """A stretch in which nothing spoke against driving."""

    part: str
    after: str = Field(description="What was done before, in words")
    command: dict[str, float] = Field(description="What the operator wants from here on")
    began_ns: int
    until_ns: int


class StopSeen(Record):
    """A reason to stop, made by the grader, and how long it lasted."""

    part: str = Field(description="The stretch's name, as its times are accounted for")
    reason: str = Field(description="The key of the card's `stops`; empty: no reason of the card")
    cause: str = Field(description="What was done, in words")
    began_ns: int
    until_ns: int = Field(description="When it was undone")


class JoinSeen(Record):
    """What a subscription got that came late to a latched topic."""

    after: str = Field(description="What was done before, in words")
    wanted: Any = Field(description="What the last message should say")
    said: int = Field(description="So many messages there should be so far")
    heard: list[Any] = Field(default_factory=list, description="In their order")
    matched: bool = True


class PressSeen(Record):
    """One call of the button's service, and what its topic said meanwhile."""

    asked: dict[str, Any]
    began_ns: int
    until_ns: int


class HostsSeen(Record):
    """The nodes on two computers."""

    refused: str = Field(default="", description="Why there could be no two computers")
    matched: bool = Field(default=False, description="The guard hears the operator")
    heard: list[Any] = Field(
        default_factory=list, description="What a late joiner on the guard's computer got"
    )
    served: bool = Field(default=False, description="The button's service was found")
    packets: dict[str, int] = Field(
        default_factory=dict, description="`passed`, `lost`, `multicast`, `cut`"
    )


class QosSeen(PartSeen):
    """All that was seen of it in an experiment."""

    NAME = "qos"

    drives: Columns[DriveSeen] = Field(default_factory=list)
    stops: Columns[StopSeen] = Field(default_factory=list)
    joins: Columns[JoinSeen] = Field(default_factory=list)
    presses: Columns[PressSeen] = Field(default_factory=list)
    moves: Columns[MoveSeen] = Field(default_factory=list, description="What the motors were told")
    sent_ns: Columns[int] = Field(default_factory=list, description="The operator's commands")
    hosts: HostsSeen | None = None
