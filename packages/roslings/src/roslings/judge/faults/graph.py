"""Faults in the ROS graph."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from ros2_on_pip.near_names import Near
from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import SentencePart, one_of, plural, some_of

EndpointKind = Literal["publisher", "subscription"]
CALLS: Mapping[EndpointKind, str] = {
    "publisher": "create_publisher",
    "subscription": "create_subscription",
}
"""What makes an endpoint in a node's code."""

LOOK_IN_FRONT = "Does it begin with ~/ or with a name and a slash, or has the node a namespace?"


def with_guess(sentence: str) -> str:
    """A sentence on a name that is nearly right, with the likely slip where one is likely.

    For a class of `NearlyNamed`, which knows the slip.
    """
    return one_of(
        other=sentence,
        namespace=f"{sentence}: another namespace?",
        case=f"{sentence}: capital letters?",
        spelling=f"{sentence}: a spelling mistake?",
        missing=f"{sentence}: a spelling mistake? {{near.missing!r}} is missing",
        extra=f"{sentence}: a spelling mistake? {{near.extra!r}} is too much",
        instead=f"{sentence}: a spelling mistake? {{near.extra!r}} stands where {{near.missing!r}}"
        " is wanted",
    )


@dataclass(eq=False)
class NearlyNamed(Fault):
    """Something is there, under another name than the card's."""

    near: Near

    @property
    def which_measured(self) -> str:
        """The likely slip; of a spelling mistake, which letters, where it is one place."""
        near = self.near
        if near.how != "spelling":
            return near.how if near.how in ("namespace", "case") else "other"
        if near.missing and near.extra:
            return "instead"
        return "missing" if near.missing else "extra" if near.extra else "spelling"


@dataclass(eq=False)
class WrongNodeName(NearlyNamed):
    """The node is there, under another name."""

    why = "Other nodes and tools find a node by its name."
    expected = "a node {near.wanted}"
    measured = with_guess("there is no {near.wanted}, but {near.found} is running")
    hint = one_of(
        namespace="Look for namespace= where your class calls super().__init__(...).",
        name="The name is the first text in super().__init__(...) of your class.",
    )

    @property
    def which_hint(self) -> str:
        """Where the name is given."""
        return "namespace" if self.near.how == "namespace" else "name"


@dataclass(eq=False)
class NodeTwice(Fault):
    """Two nodes have one name."""

    name: str
    count: int
    why = "ROS cannot tell two nodes of one name apart: settings and commands reach either."
    hint = "How often does your code make this node? Once in main() is enough."
    expected = "one node {name}"
    measured = plural(
        "count", one="{count} node with this name", other="{count} nodes with this name"
    )


@dataclass(eq=False)
class WrongTopic(NearlyNamed):
    """The node uses a topic, but under another name."""

    kind: EndpointKind
    type: str
    why = "Publisher and subscription meet only when both use the very same name."
    expected = one_of(
        publisher="a node that publishes on {near.wanted}",
        subscription="a node that subscribes to {near.wanted}",
    )
    measured = with_guess("there is no {near.wanted}, but {near.found} carries {type}")
    hint = some_of(
        name="Look at the text in {call}(...).",
        in_front=LOOK_IN_FRONT,
        check="Check with `ros2 topic list`.",
    )

    @property
    def which_expected(self) -> str:
        """What the node does with the topic."""
        return self.kind

    @property
    def which_hint(self) -> tuple[str, ...]:
        """Where the name is given, and what may put something in front of it."""
        in_front = ("in_front",) if self.near.how == "namespace" else ()
        return "name", *in_front, "check"

    @property
    def call(self) -> str:
        """Where the code gives the name."""
        return CALLS[self.kind]


@dataclass(eq=False)
class NoTopic(Fault):
    """The node uses no topic of this kind at all."""

    topic: str
    kind: EndpointKind
    why = "Without a topic, no message can go from one node to another."
    expected = one_of(
        publisher="a node that publishes on {topic}",
        subscription="a node that subscribes to {topic}",
    )
    measured = one_of(
        publisher="it publishes on no topic of its own",
        subscription="it subscribes to no topic of its own",
    )
    hint = (
        "Which calls make publishers and subscriptions in your class? And does main() make "
        "the node?"
    )
    mend = "Call self.{call}(...) in __init__ of your class, and see that main() makes the node."

    @property
    def which_expected(self) -> str:
        """What the node does with the topic."""
        return self.kind

    @property
    def which_measured(self) -> str:
        """The same."""
        return self.kind

    @property
    def call(self) -> str:
        """Which call is missing."""
        return CALLS[self.kind]


@dataclass(eq=False)
class WrongType(Fault):
    """The topic carries another kind of message."""

    topic: str
    wanted: str
    found: str
    why = "A topic carries one type of message. Other types are not delivered, without an error."
    expected = "{topic} carries {wanted}"
    measured = "it carries {found}"
    hint = "The type is the first word in create_publisher(...) or create_subscription(...)."


@dataclass(eq=False)
class TwoPublishers(Fault):
    """One publisher was asked for, more are there."""

    topic: str
    nodes: tuple[str, ...]
    why = "Two publishers on one topic mix their messages, and the counting seems to jump."
    hint = "Count the calls of create_publisher in your code. One for each topic is enough."
    expected = "one publisher on {topic}"
    measured = plural(
        "count", one="{count} publisher, from {nodes}", other="{count} publishers, from {nodes}"
    )

    @property
    def count(self) -> int:
        """How many."""
        return len(self.nodes)


@dataclass(frozen=True)
class EndOfTopic(SentencePart):
    """A node that publishes on a topic, or subscribes to it."""

    node: str
    kind: EndpointKind
    text = one_of(publisher="{node} (publisher)", subscription="{node} (subscription)")

    @property
    def which_text(self) -> str:
        """What it does."""
        return self.kind


@dataclass(eq=False)
class NotTheAskedGraph(Fault):
    """With both nodes running, the graph has something missing or something too much."""

    wanted: tuple[str | EndOfTopic, ...]
    found: tuple[str | EndOfTopic, ...]
    topic: str = ""
    """Whose publishers and subscriptions these are; empty: they are the nodes."""
    why = "The graph is the plan of the robot's program. Each part in it must be there on purpose."
    hint = "Run both nodes and look: `./roslings graph`. Does one name appear twice?"
    expected = "just {wanted}"
    measured = one_of(
        nodes="the nodes are: {found}",
        no_nodes="the nodes are: nothing",
        ends="on {topic} there are: {found}",
        no_ends="on {topic} there are: nothing",
    )

    @property
    def which_measured(self) -> str:
        """What is spoken of, and whether there is any."""
        what = "ends" if self.topic else "nodes"
        return what if self.found else f"no_{what}"
