"""What was seen of a button and a guard: presses, drives, stops, and two computers."""

from __future__ import annotations

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


class PressSeen(Record):
    """One call of the button's service, and what its topic said meanwhile."""

    asked: dict[str, object]
    began_ns: int
    until_ns: int


class HostsSeen(Record):
    """The nodes on two computers."""

    refused: str = Field(default="", description="Why there could be no two computers")
    matched: bool = Field(default=False, description="The guard hears the operator")
    heard: list[object] = Field(
        default_factory=list, description="What a late joiner on the guard's computer got"
    )
    served: bool = Field(default=False, description="The button's service was found")
    packets: dict[str, int] = Field(
        default_factory=dict, description="`passed`, `lost`, `multicast`, `cut`"
    )


class WalkSeen(Record):
    """One order of events that a guard was led through; a stretch for each is a drive or a stop."""

    events: list[str] = Field(description="The values of `orders.Happens`")
    taken: int = Field(default=0, description="So many of them happened")


class EStopSeen(PartSeen):
    """All that was seen of them in an experiment."""

    NAME = "e_stop"

    drives: Columns[DriveSeen] = Field(default_factory=list)
    stops: Columns[StopSeen] = Field(default_factory=list)
    presses: Columns[PressSeen] = Field(default_factory=list)
    moves: Columns[MoveSeen] = Field(default_factory=list, description="What the motors were told")
    walks: Columns[WalkSeen] = Field(default_factory=list)
    sent_ns: Columns[int] = Field(default_factory=list, description="The operator's commands")
    hosts: HostsSeen | None = None

    @property
    def stretches(self) -> list[DriveSeen | StopSeen]:
        """All drives and stops."""
        return [*self.drives, *self.stops]
