"""A message as the YAML, CSV or text that `ros2 topic echo` prints."""

from __future__ import annotations

import array
import sys
from dataclasses import dataclass
from typing import Any

from roslings.ros2.field_types import read_type

MORE = "..."


@dataclass(frozen=True)
class Shape:
    """How much of a message to show."""

    longest: int | None = 128
    """Elements of a list or characters of a text; None shows all."""
    no_arrays: bool = False
    no_texts: bool = False
    flow: bool = False


def as_yaml(value: Any, shape: Shape) -> str:
    """The YAML of a message, or of one field of it, ending with a newline."""
    import yaml

    plain = plain_of(value, shape)
    text = yaml.safe_dump(
        plain,
        width=sys.maxsize,
        default_flow_style=shape.flow,
        sort_keys=False,
        allow_unicode=True,
    )
    return text.removesuffix("...\n")  # PyYAML ends a lone value so


def plain_of(value: Any, shape: Shape) -> Any:
    """A message, or a part of one, as dicts, lists, numbers and texts."""
    if hasattr(value, "get_fields_and_field_types"):
        return _message(value, shape)
    if isinstance(value, bytes):
        return _text(value.decode("latin-1"), shape)
    if isinstance(value, str):
        return _text(value, shape)
    if _is_list(value):
        return _list(list(value), shape)
    return value.item() if hasattr(value, "item") else value


def _is_list(value: Any) -> bool:
    return isinstance(value, list | tuple | array.array) or type(value).__name__ == "ndarray"


def _message(message: Any, shape: Shape) -> dict[str, Any]:
    return {
        name: _field(getattr(message, name), kind, shape)
        for name, kind in message.get_fields_and_field_types().items()
    }


def _field(value: Any, kind: str, shape: Shape) -> Any:
    if shape.no_arrays and _is_list(value):
        return _counted(value, kind)
    return plain_of(value, shape)


def _counted(value: Any, kind: str) -> str:
    """What `--no-arr` shows in place of the elements."""
    field = read_type(kind)
    of = field.of.replace("/", "/msg/", 1)
    if field.length is not None:
        return f"<array type: {of}[{field.length}]>"
    bound = f"[{field.most}]" if field.most is not None else ""
    return f"<sequence type: {of}{bound}, length: {len(value)}>"


def _text(value: str, shape: Shape) -> str:
    if shape.no_texts:
        return f"<string length: <{len(value)}>>"
    if shape.longest is not None and len(value) > shape.longest:
        return value[: shape.longest] + MORE
    return value


def _list(values: list[Any], shape: Shape) -> list[Any]:
    shown = [plain_of(one, shape) for one in values[: shape.longest]]
    return shown if len(shown) == len(values) else [*shown, MORE]


def as_csv(value: Any, shape: Shape) -> str:
    """All values of a message in one line, parted by commas."""
    return ",".join(_csv_cells(value, shape))


def _csv_cells(value: Any, shape: Shape) -> list[str]:
    if isinstance(value, bytes):
        return [str(value)]
    if hasattr(value, "get_fields_and_field_types"):
        parts: list[Any] = [getattr(value, name) for name in value.get_fields_and_field_types()]
        return [cell for part in parts for cell in _csv_cells(part, shape)]
    plain = plain_of(value, shape)
    if isinstance(plain, list):
        many = len(plain) > 0 and plain[-1] == MORE
        own = list(value)[: shape.longest]
        cells = [cell for part in own for cell in _csv_cells(part, shape)]
        return [*cells, MORE] if many else cells
    return [str(plain)]


def as_indented(value: Any) -> str:
    """The YAML of a whole message as goals and results show it, with an empty line after it."""
    return as_yaml(value, Shape(longest=None))
