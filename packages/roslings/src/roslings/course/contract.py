"""What every part of a card is made of, whichever room it lies in."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from roslings.course.kinds import Kind

Plain = bool | int | float | str
Expected = Kind.EXPECTED
Stimulus = Kind.STIMULUS
Promise = Kind.PROMISE
Prose = Kind.PROSE
NUMBERS_WITHIN = 1e-6
"""So far off a number still counts, where a card says nothing: 32 bits keep seven digits."""


class Contract(BaseModel):
    """A part of the card; an unknown word in it is a mistake, not a comment."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class RateContract(Contract):
    """How often messages come, and how far from it still counts."""

    hz: Annotated[float, Expected] = Field(gt=0)
    within: Annotated[float, Kind.TOLERANCE] = Field(
        gt=0, lt=1, description="Part of the rate, e.g. 0.05 for 5 %"
    )

    @property
    def low_hz(self) -> float:
        """The slowest rate that counts."""
        return self.hz * (1 - self.within)

    @property
    def high_hz(self) -> float:
        """The fastest rate that counts."""
        return self.hz * (1 + self.within)


def as_typed(value: object) -> str:
    """A value as ROS's command line shows it."""
    return str(value).lower() if isinstance(value, bool) else str(value)
