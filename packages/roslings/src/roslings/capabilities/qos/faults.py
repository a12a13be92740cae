"""What can be wrong with quality of service, in words."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

from roslings.judge.faults import CALLS, EndpointKind, Fault
from roslings.judge.faults.sentences import Text, one_of, plural

# --- what is offered and asked for -------------------------------------------------------------


@dataclass(eq=False)
class OtherPromise(Fault, ABC):
    """What a publisher offers, or a subscription asks for, is not the card's."""

    source: ClassVar[str] = "rclpy.qos"
    """Where the name in the advice is imported from."""

    topic: str
    kind: EndpointKind

    hint = "Compare what is set with the card: `ros2 topic info -v {topic}`."

    @property
    @abstractmethod
    def advice(self) -> str:
        """The word of QoSProfile, as Python for rclpy."""

    @property
    def call(self) -> str:
        """Where the code gives it."""
        return CALLS[self.kind]

    @property
    def which_expected(self) -> str:
        """What a node does with it: a publisher offers, a subscription asks for."""
        return self.kind

    mend = (
        "Give the QoSProfile of {call}(...) for {topic} the word {advice}, from {source}. Where a"
        " number stands in its place, write a QoSProfile. `ros2 topic info -v {topic}` shows what"
        " is"
        " set."
    )


@dataclass(eq=False)
class OtherTime(OtherPromise):
    """Another time."""

    source = "rclpy.duration"

    word: str
    wanted_s: float
    found_s: float | None
    """None: it has none."""
    why = "The middleware watches these times, and nobody else does: a wrong one is not noticed."
    expected = one_of(
        publisher="on {topic} the node offers a {word} of {wanted_s:g} s",
        subscription="on {topic} the node asks for a {word} of {wanted_s:g} s",
    )
    measured = one_of(
        publisher="it offers one of {found_s:g} s",
        publisher_none="it offers none",
        subscription="it asks for one of {found_s:g} s",
        subscription_none="it asks for none",
    )

    @property
    def which_measured(self) -> str:
        """Whether it has any."""
        return f"{self.kind}_none" if self.found_s is None else self.kind

    @property
    def advice(self) -> str:
        """A Duration."""
        name = "liveliness_lease_duration" if self.word == "lease" else self.word
        return f"{name}=Duration(seconds={self.wanted_s!r})"


@dataclass(eq=False)
class OtherLiveliness(OtherPromise):
    """The other way to give signs of life."""

    wanted: str
    found: str
    expected = one_of(
        publisher="on {topic} the node offers the liveliness {wanted}",
        subscription="on {topic} the node asks for the liveliness {wanted}",
    )
    measured = one_of(publisher="it offers {found}", subscription="it asks for {found}")
    why = one_of(
        automatic="With manual_by_topic a node must give each sign of life itself; who forgets it"
        " is"
        " dead.",
        manual="With automatic the middleware gives signs of life also for a node that does"
        " nothing.",
    )

    @property
    def which_measured(self) -> str:
        """What a node does with it."""
        return self.kind

    @property
    def which_why(self) -> str:
        """What is asked for: what is bad about the other one."""
        return "automatic" if self.wanted == "automatic" else "manual"

    @property
    def advice(self) -> str:
        """The policy."""
        return f"liveliness=LivelinessPolicy.{self.wanted.upper()}"


# --- a latched topic ---------------------------------------------------------------------------


@dataclass(eq=False)
class NothingForLateJoiners(Fault):
    """Who subscribes later gets nothing."""

    topic: str
    after: str
    keeps: int
    """So many messages the publisher keeps, as the card asks."""
    why = "Who starts later must still hear what holds."
    expected = "who subscribes to {topic} after {after} gets the last message"
    measured = "it gets none"
    hint = "What is kept for who comes late? Look at the QoS of create_publisher(...) for {topic}."
    mend = (
        "Give create_publisher(...) for {topic} {profile}: it keeps messages for late joiners. A"
        " lifespan would throw them away again."
    )

    @property
    def profile(self) -> str:
        """As Python for rclpy."""
        return f"QoSProfile(depth={self.keeps}, durability=DurabilityPolicy.TRANSIENT_LOCAL)"


@dataclass(eq=False)
class OtherCountForLateJoiners(NothingForLateJoiners):
    """A late joiner gets more, or fewer, messages than the card says."""

    wanted: int
    found: Text
    why = "What is old is over. Who gets all of it obeys for a moment what holds no more."
    expected = plural(
        "wanted",
        one="who subscribes to {topic} after {after} gets {wanted} message",
        other="who subscribes to {topic} after {after} gets {wanted} messages",
    )
    measured = "it gets {found}"
    hint = (
        "How many of the last messages are kept? Look at the QoS of create_publisher(...) for"
        " {topic}."
    )
    mend = (
        "Give create_publisher(...) for {topic} {profile}: depth says how many of the last messages"
        " it keeps."
    )


@dataclass(eq=False)
class OldForLateJoiners(Fault):
    """The last message that a late joiner gets says something else."""

    topic: str
    after: str
    wanted: str
    found: str
    why = "Who comes late knows nothing else than this message."
    expected = "who subscribes to {topic} after {after} gets {wanted}"
    measured = "it gets {found}"
    hint = "When does your code publish, and what was true then?"
    mend = (
        "Publish in the function that changes it, each time; and once in __init__, what holds then."
    )
