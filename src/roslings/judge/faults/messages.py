"""Faults in what is published."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault
from roslings.rates import Rate


@dataclass(eq=False)
class NoMessages(Fault):
    """The topic is there and too little comes on it to speak of a rate."""

    topic: str
    count: int
    seconds: float
    why = "A publisher sends nothing by itself: something must call publish() again and again."
    hint = "Is there a timer (create_timer) whose function calls publish()?"

    @property
    def expected(self) -> str:
        """Messages."""
        return f"messages on {self.topic} all the time"

    @property
    def measured(self) -> str:
        """How many came."""
        return f"{self.count} message(s) in {self.seconds:.1f} s"


@dataclass(eq=False)
class WrongRate(Fault):
    """The rate is outside its limits."""

    topic: str
    wanted_hz: float
    within: float
    rate: Rate
    why = "Other nodes rely on the rate: a slow sensor is like a robot with closed eyes."

    @property
    def expected(self) -> str:
        """The rate and its tolerance."""
        return f"{self.wanted_hz:g} Hz on {self.topic} (within {self.within:.0%})"

    @property
    def measured(self) -> str:
        """The rate, how sure it is, and the period."""
        return (
            f"{self.rate.hz:.2f} Hz (±{max(self.rate.uncertainty_hz, 0.01):.2f}),"
            f" one message every {self.rate.period_s:.2f} s"
        )

    @property
    def hint(self) -> str:
        """The period to aim at."""
        return (
            f"{self.wanted_hz:g} Hz means one message every {1 / self.wanted_hz:g} s."
            " Look at the period that you give create_timer(...)."
        )


@dataclass(eq=False)
class TooSlow(WrongRate):
    """Fewer messages than asked for."""


@dataclass(eq=False)
class TooFast(WrongRate):
    """More messages than asked for."""


@dataclass(eq=False)
class Bursts(WrongRate):
    """The number is right, but the messages come in groups."""

    why = "A robot that hears nothing for a while and then everything at once acts too late."
    hint = "Publish one message in each call of the timer's function, not several in a loop."

    @property
    def expected(self) -> str:
        """Even spacing."""
        return f"one message every {1 / self.wanted_hz:g} s on {self.topic}, evenly"

    @property
    def measured(self) -> str:
        """The shape of the intervals."""
        shortest, longest = min(self.rate.periods_s), max(self.rate.periods_s)
        return f"groups: pauses from {shortest:.3f} s to {longest:.2f} s between two messages"


@dataclass(eq=False)
class WrongText(Fault):
    """A message says something else."""

    wanted: str
    found: str
    why = "Who reads these messages expects exactly this text."
    hint = "Compare letter by letter: capitals, spaces, and the number at the end."

    @property
    def expected(self) -> str:
        """The text."""
        return f"texts like {self.wanted!r}"

    @property
    def measured(self) -> str:
        """The first text that differs."""
        return f"{self.found!r}"


@dataclass(eq=False)
class WrongCount(Fault):
    """The number in the messages does not go up by one."""

    before: int
    after: int
    why = "With a number that goes up by one, a lost message is noticed."

    @property
    def expected(self) -> str:
        """The next number."""
        return f"{self.before + 1} after {self.before}"

    @property
    def measured(self) -> str:
        """The number that came."""
        return f"{self.after} after {self.before}"

    @property
    def hint(self) -> str:
        """Where to look."""
        return "Add 1 to your counter once for each message, right after publish()."


@dataclass(eq=False)
class CountSkips(WrongCount):
    """A number is left out."""


@dataclass(eq=False)
class CountRepeats(WrongCount):
    """A number comes twice."""


@dataclass(eq=False)
class CountRestarts(WrongCount):
    """The counting jumps back."""
