"""The types of fields as rosidl writes them: `double`, `sequence<int32, 3>`, `a/B[2]`."""

from __future__ import annotations

import re
from dataclasses import dataclass

INTEGERS = {
    "octet": (0, 2**8),
    "char": (0, 2**8),
    "uint8": (0, 2**8),
    "int8": (-(2**7), 2**7),
    "uint16": (0, 2**16),
    "int16": (-(2**15), 2**15),
    "uint32": (0, 2**32),
    "int32": (-(2**31), 2**31),
    "uint64": (0, 2**64),
    "int64": (-(2**63), 2**63),
}
"""Name to the smallest value and one above the largest."""

FLOATS = ("float", "double")
TEXTS = ("string", "wstring")

_SEQUENCE = re.compile(r"sequence<(?P<of>.+?)(, (?P<most>\d+))?>$")
_ARRAY = re.compile(r"(?P<of>.+)\[(?P<length>\d+)\]$")


@dataclass(frozen=True)
class FieldType:
    """One field: what it holds, and how many."""

    of: str
    """The type of one value, without bounds: `double`, `string`, `geometry_msgs/Point`."""
    many: bool = False
    length: int | None = None
    """Exactly so many, in an array."""
    most: int | None = None
    """At most so many, in a bounded sequence."""

    @property
    def is_message(self) -> bool:
        """Each value is a message of its own."""
        return "/" in self.of

    @property
    def word(self) -> str:
        """What to call one value, for a reader."""
        if self.of in INTEGERS:
            return "a whole number"
        if self.of in FLOATS:
            return "a number"
        return {"boolean": "true or false"}.get(self.of, "a text" if self.of in TEXTS else self.of)


def read_type(text: str) -> FieldType:
    """The field type that rosidl's `text` names."""
    if found := _SEQUENCE.match(text):
        most = found["most"]
        return FieldType(_unbounded(found["of"]), many=True, most=int(most) if most else None)
    if found := _ARRAY.match(text):
        return FieldType(_unbounded(found["of"]), many=True, length=int(found["length"]))
    return FieldType(_unbounded(text))


def _unbounded(text: str) -> str:
    """`string<5>` is a string."""
    return text.partition("<")[0]
