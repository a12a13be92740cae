"""A node made as its main() would make it, with or without the words of a command line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from roslings_learn.notebook.errors import NoInit, NotANode


def made(kind: Any, given: Sequence[Any], named: dict[str, Any], ros_args: Sequence[str]) -> Any:
    """`kind(*given, **named)`, started as `ros2 run PKG NAME --ros-args ros_args...` would.

    Raises NotANode, NoInit, and whatever the node's own __init__ raises.
    """
    from rclpy.node import Node

    if not (isinstance(kind, type) and issubclass(kind, Node)):
        raise NotANode(kind)
    if not ros_args:
        return kind(*given, **named)
    return _with_words(kind, list(ros_args))(*given, **named)


def _with_words(kind: Any, words: list[str]) -> Any:
    """`kind` with a class below it that hands the words to rclpy's Node.

    `super().__init__("talker")` in `kind` reaches this class first. So the node needs no change.
    """
    from rclpy.node import Node

    class Told(Node):  # type: ignore[misc] # Node is Any to the checker
        def __init__(self, *given: Any, **named: Any) -> None:
            before = named.pop("cli_args", None) or []
            self._was_told = True
            super().__init__(*given, cli_args=[*before, *_marked(words)], **named)

    def start(*given: Any, **named: Any) -> Any:
        node = type(kind.__name__, (kind, Told), {"__module__": kind.__module__})(*given, **named)
        if not getattr(node, "_was_told", False):
            node.destroy_node()
            raise NoInit(kind.__name__)
        return node

    return start


def _marked(words: list[str]) -> list[str]:
    return words if "--ros-args" in words else ["--ros-args", *words]
