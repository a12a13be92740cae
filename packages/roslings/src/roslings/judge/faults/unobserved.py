"""Faults of nodes that behave for whoever looks."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault


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

    @property
    def measured(self) -> str:
        """What the listener wrote."""
        if self.hz is None:
            return "while only your own nodes ran, your listener heard next to nothing"
        return f"while only your own nodes ran, your listener heard {self.hz:.2f} messages a second"


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

    @property
    def measured(self) -> str:
        """What was on the network."""
        often = "next to no" if self.hz is None else f"{self.hz:.2f}"
        each = "" if self.hz is None else " a second"
        return (
            "while only your own nodes ran, your listener wrote that it heard enough, but the"
            f" network carried {often} messages{each}"
        )
