"""Load all of ROS that a probe needs, into a process that opens none itself but is forked."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from importlib import import_module

from roslings.probe.content import UnknownType, message_class

OWN_TYPES = (
    "rcl_interfaces/msg/Log",
    "rcl_interfaces/msg/ParameterEvent",
    "rcl_interfaces/srv/GetParameters",
    "rosgraph_msgs/msg/Clock",
    "std_msgs/msg/Empty",
)
"""What the probe itself says and hears."""

MODULES = ("rclpy.action", "rclpy.executors", "rclpy.node", "rclpy.serialization")


def load_ros(types: Iterable[str]) -> None:
    """Load rclpy, the middleware that the environment names, and these message types.

    No node is made and nothing is sent. The tracing library that ROS is linked with starts two
    threads, which wait; a fork does not have them. Raises ImportError.
    """
    from rclpy.type_support import check_for_type_support
    from rclpy.utilities import get_rmw_implementation_identifier

    for module in MODULES:
        import_module(module)
    get_rmw_implementation_identifier()
    for name in {*OWN_TYPES, *types}:
        with suppress(UnknownType):
            check_for_type_support(message_class(name))
