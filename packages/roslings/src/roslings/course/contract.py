"""What every part of a card is made of, whichever room it lies in."""

from __future__ import annotations

from typing import Annotated, TypeVar

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


W = TypeVar("W", bound=Contract)
N = TypeVar("N", bound="NodeWords")
C = TypeVar("C", bound="CardWords")


class NodeWords(Contract):
    """Some of the words that a card may say of a node: the engine's own, or a capability's."""

    def of(self, words: type[N]) -> N:
        """The same node, by the words of a capability. Raises TypeError where nobody brings them.

        >>> LIMITER.of(ParameterWords).parameter("max_speed").default
        0.5
        """
        return _by(self, words, "a node")


class CardWords(Contract):
    """Some of the words that a card may say of the package: the engine's, or a capability's."""

    def of(self, words: type[C]) -> C:
        """The same card, by the words of a capability. Raises TypeError where nobody brings them.

        >>> CARD.of(LaunchWords).launch.file
        'launch/bring_up.launch.py'
        """
        return _by(self, words, "the package")


def _by(said: Contract, words: type[W], what: str) -> W:
    """Every card has the words of all capabilities that are here: its model is made of them."""
    if isinstance(said, words):
        return said
    raise TypeError(
        f"no capability that is here brings {words.__name__}, of {words.__module__},"
        f" to what a card says of {what}"
    )


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
