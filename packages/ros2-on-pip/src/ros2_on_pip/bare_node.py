"""A node that only looks at the graph: what DDS and ROS see of one, without rclpy's `Node` around.

rclpy's own brings a clock, parameters and a service that tells its types, and with them numpy and
a parser. They take 0.15 s of a processor before the first neighbour has answered. Discovery needs
only what lies below: a participant, a name, and one endpoint by which others see whose it is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

LISTED_BY = ("rmw_fastrtps_cpp", "rmw_fastrtps_dynamic_cpp")
"""The middlewares whose participants are known by what they hold (`participants`)."""

OF_EVERY_NODE = "/parameter_events"
"""Each node publishes it, so we do: nobody waits for the first topic of ours that never comes."""

TYPE_OF_IT = ("rcl_interfaces.rcl_interfaces_s__rosidl_typesupport_c", "parameter_event")


class BareNode:
    """The handle of a node, and what rclpy's `Node` would read from it; names are absolute."""

    def __init__(self, name: str, context: Any) -> None:
        """Raises ImportError, AttributeError or TypeError where rclpy is another than Jazzy's."""
        from rclpy.impl.implementation_singleton import rclpy_implementation
        from rclpy.topic_endpoint_info import TopicEndpointInfo

        self._ros, self._told = rclpy_implementation, TopicEndpointInfo
        module, message = TYPE_OF_IT
        capsule = getattr(import_module(module), f"type_support_msg__msg__{message}")
        with context.handle:
            self.handle = self._ros.Node(name, "/", context.handle, None, False, False)
        self._publisher = self._say_who(capsule)

    def _say_who(self, capsule: Any) -> Any:
        """The endpoint: its type is known by its support alone, so no message is imported."""
        from rclpy.qos import qos_profile_parameter_events

        message = type("Supported", (type,), {"_TYPE_SUPPORT": capsule})("Message", (), {})
        with self.handle:
            quality = qos_profile_parameter_events.get_c_qos_profile()
            return self._ros.Publisher(self.handle, message, OF_EVERY_NODE, quality)

    def destroy_node(self) -> None:
        """Leave the graph."""
        self._publisher.destroy_when_not_in_use()
        self.handle.destroy_when_not_in_use()

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Name and namespace of each node."""
        with self.handle:
            return list(self.handle.get_node_names_and_namespaces())

    def get_topic_names_and_types(
        self, no_demangle: bool = False
    ) -> list[tuple[str, Sequence[str]]]:
        """Each topic and its types; with `no_demangle` under their names in DDS."""
        with self.handle:
            return list(self._ros.rclpy_get_topic_names_and_types(self.handle, no_demangle))

    def get_service_names_and_types(self) -> list[tuple[str, Sequence[str]]]:
        """Each service and its types."""
        with self.handle:
            return list(self._ros.rclpy_get_service_names_and_types(self.handle))

    def get_publisher_names_and_types_by_node(
        self, name: str, space: str
    ) -> list[tuple[str, Sequence[str]]]:
        """What a node publishes. Raises RuntimeError where it is unknown."""
        with self.handle:
            read = self._ros.rclpy_get_publisher_names_and_types_by_node
            return list(read(self.handle, False, name, space))

    def get_subscriber_names_and_types_by_node(
        self, name: str, space: str
    ) -> list[tuple[str, Sequence[str]]]:
        """What a node subscribes to. Raises RuntimeError where it is unknown."""
        with self.handle:
            read = self._ros.rclpy_get_subscriber_names_and_types_by_node
            return list(read(self.handle, False, name, space))

    def get_service_names_and_types_by_node(
        self, name: str, space: str
    ) -> list[tuple[str, Sequence[str]]]:
        """What a node serves. Raises RuntimeError where it is unknown."""
        with self.handle:
            read = self._ros.rclpy_get_service_names_and_types_by_node
            return list(read(self.handle, name, space))

    def get_client_names_and_types_by_node(
        self, name: str, space: str
    ) -> list[tuple[str, Sequence[str]]]:
        """Which services a node calls. Raises RuntimeError where it is unknown."""
        with self.handle:
            read = self._ros.rclpy_get_client_names_and_types_by_node
            return list(read(self.handle, name, space))

    def get_publishers_info_by_topic(self, topic: str, no_mangle: bool = False) -> list[Any]:
        """What is known of each publisher of `topic`."""
        return self._infos(self._ros.rclpy_get_publishers_info_by_topic, topic, no_mangle)

    def get_subscriptions_info_by_topic(self, topic: str, no_mangle: bool = False) -> list[Any]:
        """What is known of each subscription to `topic`."""
        return self._infos(self._ros.rclpy_get_subscriptions_info_by_topic, topic, no_mangle)

    def _infos(self, read: Callable[..., Any], topic: str, no_mangle: bool) -> list[Any]:
        with self.handle:
            return [self._told(**found) for found in read(self.handle, topic, no_mangle)]

    def count_clients(self, service: str) -> int:
        """How many call it."""
        with self.handle:
            return int(self.handle.get_count_clients(service))

    def count_services(self, service: str) -> int:
        """How many serve it."""
        with self.handle:
            return int(self.handle.get_count_services(service))


def bare_node(name: str, context: Any) -> BareNode | None:
    """A bare node, or None where only rclpy's own is known to be seen as one."""
    from rclpy.utilities import get_rmw_implementation_identifier

    try:
        return BareNode(name, context) if get_rmw_implementation_identifier() in LISTED_BY else None
    except (ImportError, AttributeError, TypeError):
        return None
