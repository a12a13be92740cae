"""Messages with a number in every field: what a node drops, or turns round, is seen then."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from roslings.probe.content import message_class

FLOATS = ("float", "double")
LEAST, MOST = 0.1, 0.9


def full_values(
    type_name: str, between: Callable[[float, float], float], *, begins_below_zero: bool = False
) -> dict[str, float]:
    """Each field of floating point, by its name with dots: another number, none of them zero.

    Every other one is below zero. Two messages, of which one `begins_below_zero`, have both signs
    in each field. Numbers come from `between`, so that nobody can know them.

    Raises UnknownType where the message type is not installed.
    """
    values: dict[str, float] = {}
    for number, name in enumerate(floats_of(type_name)):
        below_zero = bool(number % 2) != begins_below_zero
        size = _another(between, [abs(value) for value in values.values()])
        values[name] = -size if below_zero else size
    return values


def floats_of(type_name: str) -> list[str]:
    """The fields of floating point of a message type, by their names with dots.

    >>> floats_of("geometry_msgs/msg/Vector3")
    ['x', 'y', 'z']

    Raises UnknownType where the message type is not installed.
    """
    return list(_floats_in(message_class(type_name)()))


def _another(between: Callable[[float, float], float], taken: list[float]) -> float:
    """A number that stands in no field yet."""
    while (size := between(LEAST, MOST)) in taken:
        pass
    return size


def _floats_in(message: Any, before: str = "") -> Iterator[str]:
    """The names of all fields of floating point, those of messages in the message too."""
    for name, kind in message.get_fields_and_field_types().items():
        value = getattr(message, name)
        if kind in FLOATS:
            yield before + name
        elif hasattr(value, "get_fields_and_field_types"):
            yield from _floats_in(value, f"{before}{name}.")
