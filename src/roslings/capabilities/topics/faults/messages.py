"""Faults in what is published."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault


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
class WrongText(Fault):
    """A message says something else."""

    wanted: str
    found: str
    was_seen = True
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

    was_seen = True


@dataclass(eq=False)
class CountRestarts(WrongCount):
    """The counting jumps back."""

    was_seen = True
