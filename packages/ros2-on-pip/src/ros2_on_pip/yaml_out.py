"""A message as the YAML, CSV or text that `ros2 topic echo` prints."""

from __future__ import annotations

import array
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from typing import Any

from ros2_on_pip.field_types import read_type

MORE = "..."


@dataclass(frozen=True)
class YamlOptions:
    """How much of a message to show."""

    longest: int | None = 128
    """Elements of a list or characters of a text; None shows all."""
    no_arrays: bool = False
    no_texts: bool = False
    flow: bool = False


def as_yaml(value: Any, shape: YamlOptions) -> str:
    """The YAML of a message, or of one field of it, ending with a newline."""
    return dumped(plain_of(value, shape), shape.flow)


def dumped(plain: Any, flow: bool = False) -> str:
    """The YAML of dicts, lists, numbers and texts; with `flow`, a field and its list in a line."""
    import yaml

    text = yaml.dump(
        plain,
        Dumper=_dumper(),
        width=sys.maxsize,
        default_flow_style=flow,
        sort_keys=False,
        allow_unicode=True,
    )
    lone = text.endswith("\n...\n")  # PyYAML ends a lone value so
    return str(text).removesuffix("...\n") if lone else str(text)


@cache
def _dumper() -> Any:
    """The real tool's flow style is one of lists only: each field has its line."""
    import yaml

    class Dumper(yaml.SafeDumper):
        """Writes each mapping as a block."""

    def block(dumper: yaml.SafeDumper, values: dict[str, Any]) -> yaml.Node:
        return dumper.represent_mapping("tag:yaml.org,2002:map", values.items(), flow_style=False)

    Dumper.add_representer(dict, block)
    return Dumper


def is_message(value: Any) -> bool:
    """It has fields."""
    return hasattr(value, "get_fields_and_field_types")


def plain_of(value: Any, shape: YamlOptions) -> Any:
    """A message, or a part of one, as dicts, lists, numbers and texts."""
    if is_message(value):
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


def _message(message: Any, shape: YamlOptions) -> dict[str, Any]:
    return {
        name: _field(getattr(message, name), kind, shape)
        for name, kind in message.get_fields_and_field_types().items()
    }


def _field(value: Any, kind: str, shape: YamlOptions) -> Any:
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


def _text(value: str, shape: YamlOptions) -> str:
    if shape.no_texts:
        return f"<string length: <{len(value)}>>"
    if shape.longest is not None and len(value) > shape.longest:
        return value[: shape.longest] + MORE
    return value


def _list(values: list[Any], shape: YamlOptions) -> list[Any]:
    shown = [plain_of(one, shape) for one in values[: shape.longest]]
    return shown if len(shown) == len(values) else [*shown, MORE]


def as_csv(value: Any, shape: YamlOptions, kind: str = "") -> str:
    """All values of a message in one line, parted by commas; an empty list is an empty column.

    `kind` is the type of the field that `value` is, as the message names it.
    """
    if is_message(value):
        fields = value.get_fields_and_field_types().items()
        return _joined(as_csv(getattr(value, name), shape, kind) for name, kind in fields)
    if _is_list(value):
        return _listed(value, shape, kind)
    if isinstance(value, str):
        return _text(value, shape)
    if isinstance(value, bytes) and shape.longest is not None and len(value) > shape.longest:
        return str(value[: shape.longest] + MORE.encode())
    return str(value)


def _listed(value: Any, shape: YamlOptions, kind: str) -> str:
    if shape.no_arrays and kind:
        return _counted(value, kind)
    cells = [as_csv(one, shape) for one in value[: shape.longest]]
    return _joined([*cells, MORE] if len(cells) < len(value) else cells)


def _joined(cells: Iterable[str]) -> str:
    """Before the first value that is not empty the real tool puts no comma."""
    line = ""
    for cell in cells:
        line = f"{line},{cell}" if line else cell
    return line


def as_indented(value: Any) -> str:
    """The YAML of a whole message as goals and results show it, with an empty line after it."""
    return as_yaml(value, YamlOptions(longest=None))
