"""Read the ROS graph through one node's eyes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Literal

from roslings.evidence import Endpoint, GraphSeen, Qos

UNLIMITED_NS = 2**63 - 1


def read_graph(eye: Any) -> GraphSeen:
    """The graph as node `eye` sees it, without `eye` itself and without hidden nodes."""
    names = (join(space, name) for name, space in eye.get_node_names_and_namespaces())
    topics = eye.get_topic_names_and_types()
    return GraphSeen(
        nodes=sorted(name for name in names if not is_hidden(name)),
        endpoints=[endpoint for name, _ in topics for endpoint in _endpoints(eye, name)],
        services={name: list(types) for name, types in eye.get_service_names_and_types()},
    )


def join(namespace: str, name: str) -> str:
    """Full name of a node."""
    return f"{namespace.rstrip('/')}/{name}"


def is_hidden(full_name: str) -> bool:
    """ROS hides names that start with an underscore; the probe's own does."""
    return full_name.rpartition("/")[2].startswith("_")


def _endpoints(eye: Any, topic: str) -> Iterable[Endpoint]:
    yield from _visible("publisher", topic, eye.get_publishers_info_by_topic(topic))
    yield from _visible("subscription", topic, eye.get_subscriptions_info_by_topic(topic))


def _visible(
    kind: Literal["publisher", "subscription"], topic: str, infos: Iterable[Any]
) -> Iterable[Endpoint]:
    for info in infos:
        node = join(info.node_namespace, info.node_name)
        if not is_hidden(node):
            yield Endpoint(
                kind=kind,
                node=node,
                topic=topic,
                type=info.topic_type,
                qos=read_qos(info.qos_profile),
                gid=bytes(info.endpoint_gid).hex(),
            )


def read_qos(profile: Any) -> Qos:
    """An rclpy QoSProfile as evidence keeps it."""
    deadline_ns = profile.deadline.nanoseconds
    return Qos(
        reliability=profile.reliability.name.lower(),
        durability=profile.durability.name.lower(),
        depth=profile.depth or None,
        deadline_ns=None if deadline_ns >= UNLIMITED_NS else deadline_ns,
        liveliness=profile.liveliness.name.lower(),
    )
