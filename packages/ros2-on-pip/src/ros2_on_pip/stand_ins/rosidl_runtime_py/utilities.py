"""From the name of a type, `std_msgs/msg/String`, to its Python class."""

from __future__ import annotations

import importlib
from typing import Any


def get_namespaced_type(identifier: str) -> tuple[str, ...]:
    """The parts of a name. Raises ValueError where there are not three."""
    parts = tuple(identifier.split("/"))
    if len(parts) != 3 or not all(parts):
        raise ValueError(f"'{identifier}' is no name of a type. Write e.g. std_msgs/msg/String")
    return parts


def get_interface(identifier: str) -> Any:
    """The class of a message, service or action.

    Raises ValueError, ModuleNotFoundError and AttributeError.
    """
    package, kind, name = get_namespaced_type(identifier)
    return getattr(importlib.import_module(f"{package}.{kind}"), name)


def get_message(identifier: str) -> Any:
    """The class of a message. Raises as `get_interface`."""
    return _of_kind(identifier, "msg")


def get_service(identifier: str) -> Any:
    """The class of a service. Raises as `get_interface`."""
    return _of_kind(identifier, "srv")


def get_action(identifier: str) -> Any:
    """The class of an action. Raises as `get_interface`."""
    return _of_kind(identifier, "action")


def _of_kind(identifier: str, kind: str) -> Any:
    if get_namespaced_type(identifier)[1] != kind:
        raise ValueError(f"'{identifier}' is not of the kind {kind}")
    return get_interface(identifier)
