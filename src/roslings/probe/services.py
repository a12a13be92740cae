"""Read from the graph who answers which service, and who may call it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Literal

from roslings.evidence import ServiceEnd

OF_ROS_ITSELF = ("rcl_interfaces/", "type_description_interfaces/")
"""Every node has these: its parameters, and the description of its types."""


def read_services(eye: Any, nodes: Iterable[str]) -> list[ServiceEnd]:
    """The services of the nodes (full names), without those of ROS itself."""
    return [end for node in sorted(set(nodes)) for end in _ends_of(eye, node)]


def _ends_of(eye: Any, node: str) -> Iterable[ServiceEnd]:
    from rclpy._rclpy_pybind11 import NodeNameNonExistentError

    space, _, name = node.rpartition("/")
    try:
        served = eye.get_service_names_and_types_by_node(name, space or "/")
        called = eye.get_client_names_and_types_by_node(name, space or "/")
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
