"""The definition of a type with the types that it is made of below each field."""

from __future__ import annotations

import re
from collections.abc import Iterator
from enum import Enum

from ros2_on_pip.field_types import FLOATS, INTEGERS, TEXTS
from ros2_on_pip.interfaces import file_of, text_of

PRIMITIVES = {*INTEGERS, *FLOATS, *TEXTS, "bool", "byte", "float32", "float64"}
_NAME = re.compile(r"^([A-Za-z][\w/]*)")


class Comments(Enum):
    """Which comments to show."""

    TOP = "those of the type itself"
    ALL = "those of every type in it too"
    NONE = "none"


def shown_lines(type_name: str, comments: Comments) -> list[str]:
    """The lines that `ros2 interface show` prints. Raises UnknownInterface."""
    package = type_name.partition("/")[0]
    return list(_lines(text_of(type_name), package, comments, level=0))


def _lines(text: str, package: str, comments: Comments, level: int) -> Iterator[str]:
    kept = comments is Comments.ALL or (comments is Comments.TOP and level == 0)
    for line in text.splitlines():
        shown = line.rstrip() if kept else _without_comment(line)
        if shown or kept:
            yield "\t" * level + shown if shown else ""
        if inner := _message_in(line, package):
            yield from _lines(text_of(inner), inner.partition("/")[0], comments, level + 1)


def _without_comment(line: str) -> str:
    """A `#` in a default text is no comment; such a text stands in quotes."""
    quoted = re.match(r"""[^#'"]*(?:'[^']*'|"[^"]*")?[^#]*""", line)
    return (quoted[0] if quoted else line).rstrip()


def _message_in(line: str, package: str) -> str | None:
    """The message type of the field in `line`; None where the line has none."""
    found = _NAME.match(line)
    if not found or found[1] in PRIMITIVES or "=" in line.partition("#")[0]:
        return None
    full = _full(found[1], package)
    return full if file_of(full) else None


def _full(name: str, package: str) -> str:
    """In a definition `Point` is of the same package, and `Header` without one is std_msgs'."""
    if "/" not in name:
        return f"{package}/msg/{name}"
    return name if name.count("/") == 2 else name.replace("/", "/msg/", 1)
