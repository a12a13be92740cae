"""ROS messages as plain values that JSON can hold, and back."""

from __future__ import annotations

import array
import importlib
import threading
from typing import Any

_loading = threading.RLock()
"""Experiments run side by side. A service marks itself as loaded before its request and its
response are. Who looks in between believes it is whole, and sends what nobody can convert."""

LONGEST_TEXT = 4096
LONGEST_LIST = 64


class UnknownType(Exception):
    """No Python class is installed for a message type."""

    def __init__(self, type_name: str) -> None:
        self.type_name = type_name
        super().__init__(f"the message type {type_name} is not installed here")


PARTS_OF_AN_ACTION = {
    "SendGoal": "SendGoalService",
    "GetResult": "GetResultService",
    "FeedbackMessage": "FeedbackMessage",
}
"""The end of a type's name in the graph, to the class that rclpy keeps inside the action's."""


def message_class(type_name: str) -> type[Any]:
    """The Python class of e.g. `std_msgs/msg/String`, with what converts it. Raises UnknownType."""
    with _loading:
        found: type[Any] = _class_of(type_name)
        meta: Any = type(found)
        if meta._TYPE_SUPPORT is None:
            meta.__import_type_support__()
    return found


def _class_of(type_name: str) -> Any:
    try:
        package, kind, name = type_name.split("/")
        module = importlib.import_module(f"{package}.{kind}")
        whole, _, part = name.rpartition("_")
        if kind == "action" and part in PARTS_OF_AN_ACTION:
            return getattr(getattr(module, whole).Impl, PARTS_OF_AN_ACTION[part])
        return getattr(module, name)
    except (ValueError, ImportError, AttributeError):
        raise UnknownType(type_name) from None


def to_plain(value: Any) -> Any:
    """A message, or a part of one, as dicts, lists, numbers and texts; long ones are cut."""
    if hasattr(value, "get_fields_and_field_types"):
        return {name: to_plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if isinstance(value, str):
        return value[:LONGEST_TEXT]
    if isinstance(value, bytes | bytearray):
        return list(value[:LONGEST_LIST])
    if isinstance(value, list | tuple | array.array) or type(value).__name__ == "ndarray":
        return [to_plain(item) for item in value[:LONGEST_LIST]]
    return value.item() if hasattr(value, "item") else value


def from_plain(type_name: str, content: dict[str, Any]) -> Any:
    """A message of `type_name` with the fields in `content`.

    Raises UnknownType, and AttributeError where the type has no such field.
    """
    message = message_class(type_name)()
    for name, value in content.items():
        current = getattr(message, name)
        if isinstance(value, dict) and hasattr(current, "get_fields_and_field_types"):
            nested = "/".join(
                (type(current).__module__.split(".")[0], "msg", type(current).__name__)
            )
            value = from_plain(nested, value)
        setattr(message, name, value)
    return message
