"""What can be wrong with quality of service, in words."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

from roslings.judge.faults import CALLS, EndpointKind, Fault

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
    def verb(self) -> str:
        """What a node does with it."""
        return "offers" if self.kind == "publisher" else "asks for"

    @property
    @abstractmethod
    def advice(self) -> str:
        """The word of QoSProfile, as Python for rclpy."""

    @property
    def mend(self) -> str:
        """Which profile gets it."""
        return (
            f"Give the QoSProfile of {CALLS[self.kind]}(...) for {self.topic} the word"
            f" {self.advice}, from {self.source}. Where a number stands in its place, write a"
            f" QoSProfile. `ros2 topic info -v {self.topic}` shows what is set."
        )


@dataclass(eq=False)
class OtherTime(OtherPromise):
    """Another time."""

    source = "rclpy.duration"

    word: str
    wanted_s: float
    found: str
    why = "The middleware watches these times, and nobody else does: a wrong one is not noticed."
    expected = "on {topic} the node {verb} a {word} of {wanted_s:g} s"
    measured = "it {verb} {found}"

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
    expected = "on {topic} the node {verb} the liveliness {wanted}"
    measured = "it {verb} {found}"

    @property
    def why(self) -> str:  # type: ignore[override]
        """What is bad about the other way."""
        if self.wanted == "automatic":
            return (
                "With manual_by_topic a node must give each sign of life itself; who forgets it is"
                " dead."
            )
        return (
            "With automatic the middleware gives signs of life also for a node that does nothing."
        )

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
    found: str
    why = "What is old is over. Who gets all of it obeys for a moment what holds no more."
    expected = "who subscribes to {topic} after {after} gets {wanted} message(s)"
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
