"""Read from the graph who answers which service, and who may call it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import Any, Literal

from roslings.capabilities.services.record import ServiceEnd

OF_ROS_ITSELF = ("rcl_interfaces/", "type_description_interfaces/")
"""Every node has these: its parameters, and the description of its types."""


def read_services(probe_node: Any, nodes: Iterable[str]) -> list[ServiceEnd]:
    """The services of the nodes (full names), without those of ROS itself.

    A service with more servers than nodes that serve it is there once for each server: a node
    itself names each of its services once.
    """
    ends = [end for node in sorted(set(nodes)) for end in _ends_of(probe_node, node)]
    servers = [end for end in ends if end.kind == "server"]
    named = Counter(end.service for end in servers)
    by_name = {end.service: end for end in servers}
    again = [
        end
        for service, end in by_name.items()
        for _ in range(probe_node.count_services(service) - named[service])
    ]
    return [*ends, *again]


def _ends_of(probe_node: Any, node: str) -> Iterable[ServiceEnd]:
    from rclpy._rclpy_pybind11 import NodeNameNonExistentError

    space, _, name = node.rpartition("/")
    try:
        served = probe_node.get_service_names_and_types_by_node(name, space or "/")
        called = probe_node.get_client_names_and_types_by_node(name, space or "/")
    except NodeNameNonExistentError:  # it has just left the graph
        return
    yield from _own("server", node, served)
    yield from _own("client", node, called)


def _own(
    kind: Literal["server", "client"], node: str, named: Iterable[tuple[str, list[str]]]
) -> Iterable[ServiceEnd]:
    for service, types in named:
        if not types[0].startswith(OF_ROS_ITSELF):
            yield ServiceEnd(kind=kind, node=node, service=service, type=types[0])
