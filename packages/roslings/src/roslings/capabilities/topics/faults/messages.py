"""Faults in what is published."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import plural


@dataclass(eq=False)
class NoMessages(Fault):
    """The topic is there and too little comes on it to speak of a rate."""

    topic: str
    count: int
    seconds: float
    why = "A publisher sends nothing by itself: something must call publish() again and again."
    hint = "Is there a timer (create_timer) whose function calls publish()?"
    expected = "messages on {topic} all the time"
    measured = plural(
        "count",
        one="{count} message in {seconds:.1f} s",
        other="{count} messages in {seconds:.1f} s",
    )


@dataclass(eq=False)
class WrongText(Fault):
    """A message says something else."""

    wanted: str
    found: str
    was_seen = True
    why = "Who reads these messages expects exactly this text."
    hint = "Compare letter by letter: capitals, spaces, and the number at the end."
    expected = "texts like {wanted!r}"
    measured = "{found!r}"


@dataclass(eq=False)
class WrongCount(Fault):
    """The number in the messages does not go up by one."""

    before: int
    after: int
    why = "With a number that goes up by one, a lost message is noticed."
    measured = "{after} after {before}"
    hint = "When does your counter change, and how often for one message?"
    mend = "Add 1 to your counter once for each message, right after publish()."

    expected = "{next} after {before}"

    @property
    def next(self) -> int:
        """The number that was to come."""
        return self.before + 1


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
