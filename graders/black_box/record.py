"""What is seen of a program that reads bags: which bag it got, and what is in there."""

from __future__ import annotations

from typing import ClassVar

from pydantic import Field

from roslings.record import Columns, PartSeen, Record


class TopicHeld(Record):
    """One topic of a bag."""

    name: str
    count: int
    rate_hz: float = Field(description="1 divided by the median period; 0 for less than two")


class PauseHeld(Record):
    """A time between two messages of one topic that is longer than usual."""

    topic: str
    seconds: float
    start_s: float = Field(description="After the first message of the bag")
    periods: float = Field(description="The same in usual periods of the topic")


class DriveHeld(Record):
    """What is in a bag, reckoned from the very messages that were written into it."""

    duration_s: float
    distance_m: float
    top_speed_m_s: float
    topics: Columns[TopicHeld]
    pauses: Columns[PauseHeld] = Field(description="Those that may be gaps, by the card's number")

    def gaps(self, periods: float) -> list[PauseHeld]:
        """The pauses that are longer than so many usual periods."""
        return [pause for pause in self.pauses if pause.periods > periods]


class BagGiven(Record):
    """One bag that the program got; the label is that of its process."""

    label: str
    path: str
    holds: DriveHeld | None = Field(description="None where there is nothing to tell")


class BagsSeen(PartSeen):
    """All bags of one experiment."""

    NAME: ClassVar[str] = "bags"

    given: Columns[BagGiven] = Field(default_factory=list)
