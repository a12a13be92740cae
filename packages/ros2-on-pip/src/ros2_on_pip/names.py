"""Names of nodes, topics and services: absolute, hidden, valid."""

from __future__ import annotations

from ros2_on_pip.problem import CommandProblem


class BadName(CommandProblem):
    """ROS does not allow the name."""

    def __init__(self, name: str, why: str) -> None:
        super().__init__(
            f"'{name}' is no valid name in ROS: {why}."
            " A name holds letters, digits and _, no digit first; parts are parted by one /."
        )


def absolute(name: str) -> str:
    """A name with its leading slash."""
    return name if name.startswith("/") else f"/{name}"


def is_hidden(name: str) -> bool:
    """A part of the name starts with an underscore."""
    return any(part.startswith("_") for part in name.split("/"))


def node_name(name: str, namespace: str) -> str:
    """The full name of a node."""
    return f"{namespace.rstrip('/')}/{name}"


def checked_node(name: str) -> str:
    """The name of a node, without a namespace. Raises BadName."""
    if not (name.isascii() and name.isidentifier()):
        raise BadName(name, "a node's name must not hold other signs")
    return name


def checked_topic(name: str) -> str:
    """The absolute name of a topic or service. Raises BadName."""
    from rclpy.exceptions import InvalidTopicNameException
    from rclpy.validate_full_topic_name import validate_full_topic_name

    full = absolute(name)
    try:
        validate_full_topic_name(full)
    except InvalidTopicNameException as fault:
        raise BadName(name, _first_sentence(str(fault))) from None
    return full


def _first_sentence(text: str) -> str:
    """rclpy's message is `Invalid topic name: REASON:` and a drawing of the place."""
    line = text.splitlines()[0]
    return line.partition(":")[2].strip(" :") or line
