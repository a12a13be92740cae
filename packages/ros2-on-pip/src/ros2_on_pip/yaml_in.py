"""YAML from the command line into a message, with errors that name the field.

rclpy checks no field by default: a text in a number's place would end the program much later.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ros2_on_pip.field_types import FLOATS, INTEGERS, TEXTS, FieldType, read_type
from ros2_on_pip.interfaces import name_of
from ros2_on_pip.problem import CommandProblem, did_you_mean

HEADER, TIME = "std_msgs/msg/Header", "builtin_interfaces/msg/Time"
Stamp = Callable[[Any], None]


class BadYaml(CommandProblem):
    """The text is no YAML."""

    def __init__(self, text: str, fault: Any) -> None:
        mark = getattr(fault, "problem_mark", None)
        reason = getattr(fault, "problem", None) or "it cannot be read"
        lines = text.splitlines() or [""]
        at = f"\n  {lines[min(mark.line, len(lines) - 1)]}\n  {' ' * mark.column}^" if mark else ""
        super().__init__(
            f"The values are no valid YAML: {reason}{at}\n"
            'The form is "{name: value, name: value}", with a space after each colon.'
        )


class NotFields(CommandProblem):
    """The YAML is fine, and holds no names of fields."""

    def __init__(self, text: str, type_name: str, fields: list[str]) -> None:
        space = " Put a space after the colon." if ":" in text else ""
        super().__init__(
            "The passed value needs to be a dictionary in YAML format:"
            f" '{text}' names no field.{space}\n"
            f"{type_name} has: {', '.join(fields) or 'no field; leave the values out'}"
        )


class BadField(CommandProblem):
    """A field does not exist, or its value does not fit."""

    def __init__(self, place: str, reason: str) -> None:
        super().__init__(f"Failed to populate field: {place}: {reason}")


def filled(message: Any, text: str) -> list[Stamp]:
    """Fill `message` from YAML; returns what must be set anew at each sending (`now`, `auto`).

    Raises BadYaml, NotFields, BadField.
    """
    values = parsed(text)
    if not isinstance(values, Mapping):
        raise NotFields(text, name_of(message), _fields(message))
    stamps: list[Stamp] = []
    _fill(message, values, "", stamps)
    return stamps


def parsed(text: str) -> Any:
    """What the YAML `text` says. Raises BadYaml."""
    import yaml

    try:
        return yaml.safe_load(text)
    except yaml.YAMLError as fault:
        raise BadYaml(text, fault) from None


def _fields(message: Any) -> list[str]:
    return list(message.get_fields_and_field_types())


def _fill(message: Any, values: Mapping[Any, Any], place: str, stamps: list[Stamp]) -> None:
    types = message.get_fields_and_field_types()
    for name, value in values.items():
        here = f"{place}.{name}" if place else str(name)
        if name not in types:
            raise BadField(here, _no_such_field(message, str(name)))
        if stamp := _stamp(getattr(message, name), value):
            stamps.append(stamp)
            continue
        setattr(message, name, _value(message, name, read_type(types[name]), value, here, stamps))


def _no_such_field(message: Any, name: str) -> str:
    fields = _fields(message)
    near = did_you_mean(name, fields)
    return f"{name_of(message)} has no field '{name}'.{near} It has: {', '.join(fields) or 'none'}"


def _stamp(current: Any, value: Any) -> Stamp | None:
    """`auto` for a header and `now` for a time are the moment of sending."""
    if value not in ("auto", "now") or not hasattr(current, "get_fields_and_field_types"):
        return None
    kind = name_of(current)
    if kind == HEADER and value == "auto":
        return lambda time: setattr(current, "stamp", time)
    if kind == TIME and value == "now":
        return lambda time: _set_time(current, time)
    return None


def _set_time(current: Any, time: Any) -> None:
    current.sec, current.nanosec = time.sec, time.nanosec


def _value(
    message: Any, name: str, kind: FieldType, value: Any, place: str, stamps: list[Stamp]
) -> Any:
    if not kind.many:
        if not kind.is_message:
            return _single(kind, value, place)
        return _message(getattr(message, name), value, place, stamps)
    if not isinstance(value, list):
        raise BadField(place, f"it needs a list, like [1, 2], and not {value!r}")
    _check_count(kind, len(value), place)
    places = [f"{place}[{index}]" for index in range(len(value))]
    if kind.is_message:
        return [
            _message(_new(kind.of), one, at, stamps) for one, at in zip(value, places, strict=True)
        ]
    return [_single(kind, one, at) for one, at in zip(value, places, strict=True)]


def _check_count(kind: FieldType, count: int, place: str) -> None:
    if kind.length is not None and count != kind.length:
        raise BadField(place, f"it needs exactly {kind.length} values, and has {count}")
    if kind.most is not None and count > kind.most:
        raise BadField(place, f"it takes at most {kind.most} values, and has {count}")


def _new(of: str) -> Any:
    from ros2_on_pip.interfaces import class_of

    return class_of(of, "msg")()


def _message(current: Any, value: Any, place: str, stamps: list[Stamp]) -> Any:
    if not isinstance(value, Mapping):
        fields = ", ".join(f"{name}: ..." for name in _fields(current))
        raise BadField(place, f"it needs {{{fields}}}, and not {value!r}")
    _fill(current, value, place, stamps)
    return current


def _single(kind: FieldType, value: Any, place: str) -> Any:
    if kind.of in INTEGERS:
        return _integer(kind, value, place)
    if kind.of in FLOATS:
        return _float(kind, value, place)
    if kind.of in TEXTS:
        return _text(value, place)
    if not isinstance(value, bool | int) or value not in (0, 1):
        raise BadField(place, f"it needs true or false, and not {value!r}")
    return bool(value)


def _integer(kind: FieldType, value: Any, place: str) -> Any:
    number = _number(value, int)
    if number is None or (isinstance(value, float) and value != number):
        raise BadField(place, f"it needs {kind.word}, and not {value!r}")
    least, beyond = INTEGERS[kind.of]
    if not least <= number < beyond:
        span = f"from {least} to {beyond - 1}"
        raise BadField(place, f"{number} is out of range: {kind.of} goes {span}")
    return bytes([number]) if kind.of == "octet" else number


def _float(kind: FieldType, value: Any, place: str) -> float:
    number = _number(value, float)
    if number is None:
        raise BadField(place, f"it needs {kind.word}, and not {value!r}")
    return float(number)


def _number(value: Any, kind: type[Any]) -> Any:
    """YAML reads 1e3 and '5' as texts; ROS takes them as numbers. None where it is none."""
    if isinstance(value, bytes | list | Mapping) or value is None:
        return None
    try:
        return kind(value)
    except (ValueError, OverflowError):
        return None


def _text(value: Any, place: str) -> str:
    if isinstance(value, list | Mapping) or value is None:
        raise BadField(place, f"it needs a text, and not {value!r}. Put the text in quotes.")
    return str(value)
