"""Faults in what a node makes of the values that it hears, and in what its messages hold."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault


@dataclass(eq=False)
class WrongField(Fault):
    """A field of the messages is not what the card says."""

    topic: str
    name: str
    wanted: str
    found: str
    why = "Who reads these messages takes each field at its word."
    expected = "on {topic}, the field {name} is {wanted}"
    measured = "it is {found}"
    hint = "Which line fills {name}, before you publish?"
    mend = (
        "Fill it before you publish: MESSAGE.{name} = ... A field that nobody fills is 0 or empty."
    )

    @property
    def headline(self) -> str:
        """With the field's name."""
        return f"{self.name} is {self.found}"


@dataclass(eq=False)
class NoStamp(Fault):
    """The messages do not say when they were made."""

    topic: str
    why = "A distance or a picture without its time is of no use to a robot that moves."
    hint = "Which line fills the header's stamp, and of which message?"
    mend = "Fill it in each message: MESSAGE.header.stamp = self.get_clock().now().to_msg()"
    expected = "on {topic}, header.stamp is the time at which the message is made"
    measured = "header.stamp is 0: nobody filled it"


@dataclass(eq=False)
class OldStamp(NoStamp):
    """The stamp is not the time of the message."""

    behind_s: float
    hint = "When does your code look at the clock?"
    mend = (
        "Take the time in the function that publishes, not in __init__:"
        " self.get_clock().now().to_msg()"
    )

    @property
    def measured(self) -> str:  # type: ignore[override]
        """How far it is off."""
        return f"header.stamp is {abs(self.behind_s):.1f} s away from the time of sending"


@dataclass(eq=False)
class WrongReaction(Fault):
    """The node was told a value, and shows another one than it should."""

    topic: str
    field_name: str
    heard: str
    wanted: str
    found: str | None
    remark: str = ""
    why = "A robot acts on this value. A wrong one sends it against the wall."
    hint = (
        "Take this one case, with its numbers, and go through your code with it by hand, line by"
        " line."
    )
    expected = "after {heard}: {field_name} {wanted} on {topic}"

    @property
    def measured(self) -> str:
        """The value that came, and what it looks like."""
        return f"{self._came}{self.remark}"

    @property
    def headline(self) -> str:
        """With the case, and the topic."""
        return f"{self._case}: {self._came} on {self.topic}{self.remark}"

    @property
    def _came(self) -> str:
        return "no message" if self.found is None else f"{self.field_name} {self.found}"

    @property
    def _case(self) -> str:
        return f"after {self.heard}"


@dataclass(eq=False)
class NotInfinite(WrongReaction):
    """A value out of range is published as if it were a distance."""

    why = (
        "ROS has a rule for this, REP 117: too near is -infinity, too far is +infinity. A number"
        " means: it was really measured."
    )
    hint = "What does your code publish for a value that is out of range?"
    mend = (
        "Compare with min_range and max_range before you publish, and put in -math.inf or"
        " math.inf. NaN stays NaN."
    )


@dataclass(eq=False)
class DoesNotReact(WrongReaction):
    """Nothing was published after the value."""

    why = "Who hears nothing does not know whether all is well or the node is dead."
    hint = "Is the function reached (log a line in it), and does it call publish() each time?"


@dataclass(eq=False)
class EndedWhileHearing(WrongReaction):
    """The node ended when it heard the value."""

    why = "Real sensors send NaN and infinities. A node that ends at one of them stops the robot."
    hint = "Read the last lines below: the last one names the error. Which value had come?"
    mend = (
        "Read the last lines below. Python cannot make an int of NaN or of an infinity: ask"
        " math.isfinite(VALUE) first."
    )
    measured = "the node ended with an error"

    @property
    def headline(self) -> str:
        """With the case."""
        return f"{self._case}: {self.measured}"


@dataclass(eq=False)
class WrongAtFirst(WrongReaction):
    """The node shows a value before it has been told any."""

    why = "A number means that something was measured. Before that, the sensor knows nothing."
    hint = "What do you put into your variable in __init__? It is published until a value comes."
    expected = "before anything was heard: {field_name} {wanted} on {topic}"

    @property
    def _case(self) -> str:
        return "before anything was heard"


@dataclass(eq=False)
class MoreThanAsked(Fault):
    """More is published than the card asks for."""

    topic: str
    told: int
    came: int
    why = "Who hears a message takes it for news: twice the same message is a wrong one."
    hint = "From how many places in your code is publish() called?"
    mend = "Call publish() once, in the function that hears a message, and in no timer."
    expected = "one message on {topic} for each that is heard ({told} were told)"
    measured = "{came} messages came"
