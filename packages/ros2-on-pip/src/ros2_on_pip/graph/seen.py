"""The graph at one moment: which nodes there are, and who publishes or subscribes to what."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, Protocol

from ros2_on_pip.discovery import DirectNode
from ros2_on_pip.names import node_name
from ros2_on_pip.qos import mismatches

PUBLISHER, SUBSCRIPTION = "publisher", "subscription"


class GraphEndpoint(Protocol):
    """One publisher or subscription."""

    @property
    def kind(self) -> str:
        """`publisher` or `subscription`."""

    @property
    def node(self) -> str:
        """Full name of the node, e.g. `/talker`."""

    @property
    def topic(self) -> str:
        """Its topic, e.g. `/chatter`."""

    @property
    def type(self) -> str:
        """e.g. `std_msgs/msg/String`."""


class Graph(Protocol):
    """What is drawn and told, whoever has seen it."""

    @property
    def nodes(self) -> Sequence[str]:
        """Full names; a name stands there as often as it was seen."""

    @property
    def endpoints(self) -> Sequence[GraphEndpoint]:
        """Of all nodes."""


@dataclass(frozen=True)
class EndpointNow:
    """A publisher or a subscription that is there now."""

    kind: str
    node: str
    topic: str
    type: str
    qos: Any
    """An rclpy QoSProfile."""


@dataclass(frozen=True)
class GraphNow:
    """The graph at this moment."""

    nodes: list[str]
    endpoints: list[EndpointNow]


def graph_seen_by(direct_node: DirectNode) -> GraphNow:
    """The graph, without `direct_node` and without those of other looks at the graph."""
    topics = sorted(name for name, _ in direct_node.graph.get_topic_names_and_types())
    ends = (end for topic in topics for end in _ends(direct_node, topic))
    return GraphNow(
        nodes=[name for name in direct_node.nodes(hidden=True) if not _only_looks(name)],
        endpoints=[end for end in ends if not _only_looks(end.node)],
    )


def _ends(direct_node: DirectNode, topic: str) -> Iterator[EndpointNow]:
    for kind, infos in (
        (PUBLISHER, direct_node.publishers(topic)),
        (SUBSCRIPTION, direct_node.subscriptions(topic)),
    ):
        for info in infos:
            node = node_name(info.node_name, info.node_namespace)
            yield EndpointNow(kind, node, topic, info.topic_type, info.qos_profile)


def _only_looks(node: str) -> bool:
    """The command line's own nodes have names that begin with `_`."""
    return node.rpartition("/")[2].startswith("_")


def misfits(graph: GraphNow) -> list[str]:
    """A sentence for each publisher and subscription of one topic that do not fit together."""
    by_topic: dict[str, list[EndpointNow]] = {}
    for end in graph.endpoints:
        by_topic.setdefault(end.topic, []).append(end)
    found = (said for ends in by_topic.values() for said in _misfits_of(ends))
    return list(dict.fromkeys(found))


def _misfits_of(ends: Sequence[EndpointNow]) -> Iterator[str]:
    publishers = [end for end in ends if end.kind == PUBLISHER]
    subscriptions = [end for end in ends if end.kind == SUBSCRIPTION]
    for one, other in product(publishers, subscriptions):
        for why in _why(one, other):
            yield f"On {one.topic} no message goes from {one.node} to {other.node}: {why}."


def _why(publisher: EndpointNow, subscription: EndpointNow) -> list[str]:
    if publisher.type != subscription.type:
        return [f"it has the type {publisher.type}, and {subscription.type} is asked for"]
    return mismatches(subscription.qos, publisher.qos)
