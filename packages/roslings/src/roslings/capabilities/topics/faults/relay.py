"""Faults in what a node makes of the values that it hears, and in what its messages hold."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import SentencePart, Text, one_of, plural
from roslings.judge.values import Looks


@dataclass(frozen=True)
class Heard(SentencePart):
    """What a node was told on a topic: the last value, and the one before where that counts."""

    field: str
    values: tuple[str, ...]
    topic: str
    text = one_of(
        one="{field} {values[0]} on {topic}",
        two="{field} {values[0]}, then {values[1]} on {topic}",
    )

    @property
    def which_text(self) -> str:
        """How many values."""
        return "one" if len(self.values) == 1 else "two"


@dataclass(eq=False)
class WrongField(Fault):
    """A field of the messages is not what the card says."""

    topic: str
    name: str
    wanted: Text
    found: Text
    looks: Looks | None = None
    why = "Who reads these messages takes each field at its word."
    expected = "on {topic}, the field {name} is {wanted}"
    measured = one_of(plain="it is {found}", looks="it is {found}, {looks}")
    headline = one_of(plain="{name} is {found}", looks="{name} is {found}, {looks}")
    hint = "Which line fills {name}, before you publish?"
    mend = (
        "Fill it before you publish: MESSAGE.{name} = ... A field that nobody fills is 0 or empty."
    )

    @property
    def which_measured(self) -> str:
        """Whether the value looks like something."""
        return "looks" if self.looks else "plain"

    @property
    def which_headline(self) -> str:
        """The same."""
        return self.which_measured


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

    measured = "header.stamp is {away_s:.1f} s away from the time of sending"

    @property
    def away_s(self) -> float:
        """How far it is off, before or behind."""
        return abs(self.behind_s)


@dataclass(eq=False)
class WrongReaction(Fault):
    """The node was told a value, and shows another one than it should."""

    topic: str
    field_name: str
    heard: Text
    wanted: str
    found: str | None
    looks: Looks | None = None
    why = "A robot acts on this value. A wrong one sends it against the wall."
    hint = (
        "Take this one case, with its numbers, and go through your code with it by hand, line by"
        " line."
    )
    expected = "after {heard}: {field_name} {wanted} on {topic}"

    measured = one_of(
        nothing="no message",
        plain="{field_name} {found}",
        looks="{field_name} {found}, {looks}",
    )
    headline = one_of(
        nothing="after {heard}: no message on {topic}",
        plain="after {heard}: {field_name} {found} on {topic}",
        looks="after {heard}: {field_name} {found} on {topic}, {looks}",
    )

    @property
    def which_measured(self) -> str:
        """The value that came, and what it looks like."""
        return "nothing" if self.found is None else "looks" if self.looks else "plain"

    @property
    def which_headline(self) -> str:
        """The same."""
        return self.which_measured


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

    headline = "after {heard}: the node ended with an error"


@dataclass(eq=False)
class WrongAtFirst(WrongReaction):
    """The node shows a value before it has been told any."""

    why = "A number means that something was measured. Before that, the sensor knows nothing."
    hint = "What do you put into your variable in __init__? It is published until a value comes."
    expected = "before anything was heard: {field_name} {wanted} on {topic}"

    headline = one_of(
        nothing="before anything was heard: no message on {topic}",
        plain="before anything was heard: {field_name} {found} on {topic}",
        looks="before anything was heard: {field_name} {found} on {topic}, {looks}",
    )


@dataclass(eq=False)
class MoreThanAsked(Fault):
    """More is published than the card asks for."""

    topic: str
    told: int
    came: int
    why = "Who hears a message takes it for news: twice the same message is a wrong one."
    hint = "From how many places in your code is publish() called?"
    mend = "Call publish() once, in the function that hears a message, and in no timer."
    expected = plural(
        "told",
        one="one message on {topic} for each that is heard ({told} was told)",
        other="one message on {topic} for each that is heard ({told} were told)",
    )
    measured = plural("came", one="{came} message came", other="{came} messages came")
