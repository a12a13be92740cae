"""Faults in the ROS graph."""

from __future__ import annotations

from dataclasses import dataclass

from ros2_on_pip.near_names import Near
from roslings.judge.faults.base import Fault


@dataclass(eq=False)
class WrongNodeName(Fault):
    """The node is there, under another name."""

    near: Near
    why = "Other nodes and tools find a node by its name."
    expected = "a node {near.wanted}"

    @property
    def measured(self) -> str:
        """The name that is there."""
        return f"there is no {self.near.wanted}, but {self.near.found} is running{guess(self.near)}"

    @property
    def hint(self) -> str:
        """Where the name is given."""
        if self.near.how == "namespace":
            return "Look for namespace= where your class calls super().__init__(...)."
        return "The name is the first text in super().__init__(...) of your class."


@dataclass(eq=False)
class NodeTwice(Fault):
    """Two nodes have one name."""

    name: str
    count: int
    why = "ROS cannot tell two nodes of one name apart: settings and commands reach either."
    hint = "How often does your code make this node? Once in main() is enough."
    expected = "one node {name}"
    measured = "{count} nodes with this name"


@dataclass(eq=False)
class WrongTopic(Fault):
    """The node uses a topic, but under another name."""

    near: Near
    verb: str
    type: str
    why = "Publisher and subscription meet only when both use the very same name."
    expected = "a node that {verb} {near.wanted}"

    @property
    def measured(self) -> str:
        """The topic that is there, and the likely slip."""
        return (
            f"there is no {self.near.wanted}, but {self.near.found} carries"
            f" {self.type}{guess(self.near)}"
        )

    @property
    def hint(self) -> str:
        """Where the name is given."""
        call = "create_publisher" if self.verb.startswith("publishes") else "create_subscription"
        return (
            f"Look at the text in {call}(...).{look_in_front(self.near)} Check with"
            " `ros2 topic list`."
        )


@dataclass(eq=False)
class NoTopic(Fault):
    """The node uses no topic of this kind at all."""

    topic: str
    verb: str
    why = "Without a topic, no message can go from one node to another."
    expected = "a node that {verb} {topic}"
    measured = "it {verb} no topic of its own"

    hint = (
        "Which calls make publishers and subscriptions in your class? And does main() make "
        "the node?"
    )

    @property
    def mend(self) -> str:
        """Which call is missing."""
        call = "create_publisher" if self.verb.startswith("publishes") else "create_subscription"
        return (
            f"Call self.{call}(...) in __init__ of your class, and see that main() makes the node."
        )


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

    @property
    def measured(self) -> str:
        """How many."""
        return f"{len(self.nodes)} publishers, from {', '.join(self.nodes)}"


@dataclass(eq=False)
class NotTheAskedGraph(Fault):
    """With both nodes running, the graph has something missing or something too much."""

    wanted: tuple[str, ...]
    found: tuple[str, ...]
    what: str
    why = "The graph is the plan of the robot's program. Each part in it must be there on purpose."
    hint = "Run both nodes and look: `./roslings graph`. Does one name appear twice?"

    @property
    def expected(self) -> str:
        """The asked graph."""
        return f"just {', '.join(self.wanted)}"

    @property
    def measured(self) -> str:
        """What is there instead."""
        return f"{self.what}: {', '.join(self.found) or 'nothing'}"


def look_in_front(near: Near) -> str:
    """What puts a namespace in front of a name, as a sentence; empty where none is in front."""
    if near.how != "namespace":
        return ""
    return " Does it begin with ~/ or with a name and a slash, or has the node a namespace?"


def guess(near: Near) -> str:
    """The likely slip, as the end of a sentence; empty where none is likely."""
    sentences = {
        "namespace": ": another namespace?",
        "case": ": capital letters?",
        "spelling": f": a spelling mistake? {near.slip}".rstrip(),
    }
    return sentences.get(near.how, "")
