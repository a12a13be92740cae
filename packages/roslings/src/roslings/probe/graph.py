"""Read the ROS graph as one node sees it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import takewhile
from typing import Any, Literal, NamedTuple, TypeVar

from roslings.evidence import Endpoint, GraphSeen, Qos
from roslings.probe.budget import MB, ByteBudget, size_of

MOST_BYTES = 4 * MB
"""Of a graph: some 4,000 endpoints."""

UNLIMITED_NS = 2**63 - 1
UNNAMED = "_NODE_NAME_UNKNOWN_"
"""What rcl calls the node of an endpoint until discovery has brought its name."""
T = TypeVar("T")


class GraphOutline(NamedTuple):
    """All that is quick to read; `counts` are publishers and subscriptions, topic by topic."""

    nodes: list[tuple[str, str]]
    topics: list[tuple[str, list[str]]]
    services: list[tuple[str, list[str]]]
    counts: list[tuple[int, int]]

    @property
    def size(self) -> int:
        """How many names and endpoints there are."""
        return len(self.nodes) + len(self.services) + sum(map(sum, self.counts))


class GraphBudget(ByteBudget):
    """A budget that remembers whether it had to refuse something."""

    refused = False

    def take(self, size: int) -> bool:
        """Take `size` bytes, where as much is left."""
        fits = super().take(size)
        self.refused = self.refused or not fits
        return fits


class Looker:
    """Reads the graph again when something in it has changed.

    To read all endpoints takes rclpy ten times as long as to count them.
    """

    def __init__(self, probe_node: Any, most_bytes: int = MOST_BYTES) -> None:
        self._node, self._most_bytes = probe_node, most_bytes
        self._outline: GraphOutline | None = None
        self._all_named = False
        self.left_out = 0
        """Names and endpoints that found no room in the graph that was read last."""

    def changed(self) -> GraphSeen | None:
        """The graph; None where it is what was read last."""
        outline = outline_of(self._node)
        if self._all_named and outline == self._outline:
            return None
        return self._read(outline)

    def read(self) -> GraphSeen:
        """The graph, whatever was read before."""
        return self._read(outline_of(self._node))

    def _read(self, outline: GraphOutline) -> GraphSeen:
        """`outline` is older: what comes meanwhile is seen next time."""
        room = GraphBudget(self._most_bytes)
        names = (join(space, name) for name, space in outline.nodes)
        nodes = list(_fitting(names, room))
        found = list(_fitting(_endpoints(self._node, outline), room))
        services = dict(_fitting(((name, list(types)) for name, types in outline.services), room))
        self._outline = outline
        self._all_named = all(each.node.rpartition("/")[2] != UNNAMED for each in found)
        kept = len(nodes) + len(found) + len(services)
        # Where all had room, what is fewer than in the outline has gone since.
        self.left_out = max(0, outline.size - kept) if room.refused else 0
        return GraphSeen(
            nodes=sorted(name for name in nodes if not is_hidden(name)),
            endpoints=[each for each in found if not is_hidden(each.node)],
            services=services,
        )


def _fitting(records: Iterable[T], room: ByteBudget) -> Iterator[T]:
    """The first ones, as many as find room."""
    return takewhile(lambda each: room.take(size_of(each)), records)


def outline_of(probe_node: Any) -> GraphOutline:
    """The outline of the graph as node `probe_node` sees it."""
    topics = probe_node.get_topic_names_and_types()
    return GraphOutline(
        nodes=probe_node.get_node_names_and_namespaces(),
        topics=topics,
        services=probe_node.get_service_names_and_types(),
        counts=[
            (probe_node.count_publishers(name), probe_node.count_subscribers(name))
            for name, _ in topics
        ],
    )


def join(namespace: str, name: str) -> str:
    """Full name of a node."""
    return f"{namespace.rstrip('/')}/{name}"


def is_hidden(full_name: str) -> bool:
    """ROS hides names that start with an underscore; the probe's own does."""
    return full_name.rpartition("/")[2].startswith("_")


def _endpoints(probe_node: Any, outline: GraphOutline) -> Iterator[Endpoint]:
    for topic, _ in outline.topics:
        for info in probe_node.get_publishers_info_by_topic(topic):
            yield _endpoint("publisher", topic, info)
        for info in probe_node.get_subscriptions_info_by_topic(topic):
            yield _endpoint("subscription", topic, info)


def _endpoint(kind: Literal["publisher", "subscription"], topic: str, info: Any) -> Endpoint:
    return Endpoint(
        kind=kind,
        node=join(info.node_namespace, info.node_name),
        topic=topic,
        type=info.topic_type,
        qos=read_qos(info.qos_profile),
        gid=bytes(info.endpoint_gid).hex(),
    )


def read_qos(profile: Any) -> Qos:
    """An rclpy QoSProfile as evidence keeps it."""
    return Qos(
        reliability=profile.reliability.name.lower(),
        durability=profile.durability.name.lower(),
        depth=profile.depth or None,
        deadline_ns=_limit_ns(profile.deadline),
        liveliness=profile.liveliness.name.lower(),
        lifespan_ns=_limit_ns(profile.lifespan),
        lease_ns=_limit_ns(profile.liveliness_lease_duration),
    )


def _limit_ns(duration: Any) -> int | None:
    """An rclpy Duration; None where it has no end."""
    limit_ns: int = duration.nanoseconds
    return None if limit_ns >= UNLIMITED_NS else limit_ns
