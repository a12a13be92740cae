"""A form made from a type: a control for each field, and from what is typed a message again.

A field that nobody touched keeps the default of its type. A list is typed as YAML, `[1, 2]`, and a
time is `now` unless somebody types another one.
"""

from __future__ import annotations

from typing import Any

import yaml

from ros2_on_pip.field_types import FLOATS, INTEGERS, TEXTS, FieldType, read_type
from ros2_on_pip.interfaces import name_of
from ros2_on_pip.yaml_in import TIME, BadField, BadYaml, Stamp, filled, parsed
from ros2_on_pip.yaml_out import YamlOptions, dumped, plain_of
from roslings_desk.controls import CheckField, ControlField, PageText, TextField, part

MOST_FIELDS = 60
Place = tuple[str, ...]


class Form:
    """The fields of a message of `cls`; `cls` may be a service's request or a goal, too."""

    def __init__(self, cls: Any) -> None:
        self._cls = cls
        self._fields: dict[Place, tuple[FieldType, ControlField, Any]] = {}
        self._left_out = 0
        message = cls()
        with part("div", "form"):
            self._show(message, ())
            if not message.get_fields_and_field_types():
                PageText("p", "It has no fields.", "hint")
            if self._left_out:
                PageText("p", f"{self._left_out} more fields keep their defaults.", "hint")

    def filled(self) -> tuple[Any, list[Stamp]]:
        """The message, and what is to be set at each sending. Raises BadField."""
        message = self._cls()
        values: dict[str, Any] = {}
        for place, (kind, control, default) in self._fields.items():
            if control.value != default:
                _put(values, place, _value(kind, control.value, place))
            elif default == "now":
                _put(values, place, "now")
        return message, filled(message, yaml.safe_dump(values))

    def _show(self, message: Any, place: Place) -> None:
        for name, text in message.get_fields_and_field_types().items():
            here, kind, value = (*place, name), read_type(text), getattr(message, name)
            if kind.is_message and not kind.many and name_of(value) != TIME:
                with part("fieldset"):
                    PageText("legend", f"{name} ({kind.of})")
                    self._show(value, here)
            elif len(self._fields) >= MOST_FIELDS:
                self._left_out += 1
            else:
                self._fields[here] = _control(f"{'.'.join(here)} ({text})", kind, value)


def _control(label: str, kind: FieldType, value: Any) -> tuple[FieldType, ControlField, Any]:
    if kind.of == "boolean" and not kind.many:
        return kind, CheckField(label, bool(value)), bool(value)
    typed = _typed(kind, value)
    return kind, TextField(label, typed), typed


def _typed(kind: FieldType, value: Any) -> str:
    """A default as it is typed."""
    if kind.is_message and not kind.many:
        return "now"
    if kind.of in TEXTS and not kind.many:
        return str(value)
    if not kind.many and (kind.of in INTEGERS or kind.of in FLOATS):
        return str(value[0] if isinstance(value, bytes) else value)
    return dumped(plain_of(value, YamlOptions(longest=None)), flow=True).strip()


def _value(kind: FieldType, typed: Any, place: Place) -> Any:
    """What was typed, as YAML means it; a text is a text as it stands."""
    if isinstance(typed, bool) or (kind.of in TEXTS and not kind.many) or typed == "now":
        return typed
    try:
        return parsed(typed)
    except BadYaml as error:
        reason = str(error).splitlines()[0]
        raise BadField(".".join(place), reason) from error


def _put(values: dict[str, Any], place: Place, value: Any) -> None:
    for name in place[:-1]:
        values = values.setdefault(name, {})
    values[place[-1]] = value
