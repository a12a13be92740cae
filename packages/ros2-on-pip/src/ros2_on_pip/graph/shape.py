"""The ROS graph as nodes, topics and the arrows between them, without what every node has."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable
from dataclasses import dataclass

from ros2_on_pip.graph.seen import Graph, GraphEndpoint

# Topics that rclpy gives every node, and their types (rcl's logging, ROS 2's parameters).
INFRASTRUCTURE = {
    "/rosout": "rcl_interfaces/msg/Log",
    "/parameter_events": "rcl_interfaces/msg/ParameterEvent",
}


@dataclass(frozen=True)
class NodeShape:
    """All nodes of one full name; `count` is more than 1 where several run under it."""

    name: str
    count: int


@dataclass(frozen=True)
class TopicShape:
    """One topic, its types (more than one is a mistake), and the nodes at both of its ends."""

    name: str
    types: tuple[str, ...]
    publishers: tuple[str, ...]
    subscribers: tuple[str, ...]


@dataclass(frozen=True)
class GraphShape:
    """What is drawn and told of a graph, by name; `hidden` are the names that are left out."""

    nodes: tuple[NodeShape, ...]
    topics: tuple[TopicShape, ...]
    hidden: tuple[str, ...] = ()

    @property
    def alone(self) -> tuple[NodeShape, ...]:
        """The nodes that no topic of this shape touches."""
        busy = {node for topic in self.topics for node in topic.publishers + topic.subscribers}
        return tuple(node for node in self.nodes if node.name not in busy)


def shape_of(graph: Graph, *, show_hidden: bool = False) -> GraphShape:
    """The shape of `graph`; with `show_hidden` also /rosout, /parameter_events and hidden names.

    A name is hidden in ROS where a part of it begins with `_`, e.g. the command line's daemon.
    """
    shown = [end for end in graph.endpoints if show_hidden or not _hides(end)]
    nodes = Counter(graph.nodes)
    for end in shown:
        nodes[end.node] = max(nodes[end.node], 1)  # seen by its endpoint, not yet by its name
    visible = {name for name in nodes if show_hidden or not _is_hidden_name(name)}
    left_out = {end.topic for end in graph.endpoints} - {end.topic for end in shown}
    return GraphShape(
        nodes=tuple(NodeShape(name, nodes[name]) for name in sorted(visible)),
        topics=_topics(shown),
        hidden=tuple(sorted(left_out | (set(nodes) - visible))),
    )


def _hides(end: GraphEndpoint) -> bool:
    return (
        _is_infrastructure(end.topic, end.type)
        or _is_hidden_name(end.topic)
        or _is_hidden_name(end.node)
    )


def _is_infrastructure(topic: str, kind: str) -> bool:
    """By name; or, put into a namespace, by name and type."""
    return topic in INFRASTRUCTURE or any(
        topic.endswith(name) and kind == its_type for name, its_type in INFRASTRUCTURE.items()
    )


def _is_hidden_name(name: str) -> bool:
    return "/_" in name


def _topics(endpoints: Iterable[GraphEndpoint]) -> tuple[TopicShape, ...]:
    by_topic: dict[str, list[GraphEndpoint]] = defaultdict(list)
    for end in endpoints:
        by_topic[end.topic].append(end)
    return tuple(
        TopicShape(
            name=topic,
            types=tuple(sorted({end.type for end in ends})),
            publishers=_nodes_of(ends, "publisher"),
            subscribers=_nodes_of(ends, "subscription"),
        )
        for topic, ends in sorted(by_topic.items())
    )


def _nodes_of(endpoints: Iterable[GraphEndpoint], kind: str) -> tuple[str, ...]:
    return tuple(sorted({end.node for end in endpoints if end.kind == kind}))
