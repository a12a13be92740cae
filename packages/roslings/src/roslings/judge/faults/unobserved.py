"""Faults of nodes that behave for whoever looks."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class SpeaksOnlyWhenObserved(Fault):
    """The talker is slower, or silent, while nobody but the listener is there."""

    topic: str
    wanted_hz: float
    hz: float | None
    why = "On a robot nobody from outside listens: the nodes have only each other."
    hint = "What does your code look at before it publishes?"
    mend = (
        "Publish in the timer's function each time. Do not look first at who else is in the graph."
    )
    expected = "{wanted_hz:g} Hz on {topic}, also while only your own nodes run"

    measured = one_of(
        slow="while only your own nodes ran, your listener heard {hz:.2f} messages a second",
        silent="while only your own nodes ran, your listener heard next to nothing",
    )

    @property
    def which_measured(self) -> str:
        """What the listener wrote."""
        return "silent" if self.hz is None else "slow"


@dataclass(eq=False)
class WritesWhatWasNotSent(Fault):
    """The listener writes messages that never were on the network."""

    topic: str
    wanted_hz: float
    hz: float | None
    why = "A line in a log is no message: a robot drives by what arrives."
    hint = "Which function writes this line, and when is it called?"
    mend = "Write a line in the callback alone, once for each message that came."
    expected = "{wanted_hz:g} Hz on {topic}, also while only your own nodes run"

    measured = one_of(
        some="while only your own nodes ran, your listener wrote that it heard enough, but the"
        " network carried {hz:.2f} messages a second",
        none="while only your own nodes ran, your listener wrote that it heard enough, but the"
        " network carried next to no messages",
    )

    @property
    def which_measured(self) -> str:
        """What was on the network."""
        return "none" if self.hz is None else "some"
