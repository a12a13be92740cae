"""The fields of a type, from the text that defines it: no type need be built or imported."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from ros2_on_pip.interfaces import UnknownInterface
from roslings.course import Lab, root
from roslings_launcher.interface_sources import packages_of

Kind = Literal["float", "int", "unsigned", "bool", "string"]
KINDS: dict[str, Kind] = {
    "float32": "float",
    "float64": "float",
    "bool": "bool",
    "string": "string",
    **{f"int{bits}": "int" for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": "unsigned" for bits in (8, 16, 32, 64)},
}
FIELD = re.compile(
    r"^\s*(?P<type>[\w/]+)(?P<many>\[[^\]]*\])?(<=\d+)?\s+(?P<name>[a-z]\w*)\b(?!\s*=)"
)


@dataclass(frozen=True)
class MessageField:
    """One value in a message."""

    path: str
    """A dot leads into it: `linear.x`."""
    kind: Kind

    @property
    def is_number(self) -> bool:
        """Whether it can be doubled."""
        return self.kind in ("float", "int", "unsigned")

    @property
    def around(self) -> str:
        """The path of the message that it stands in."""
        return self.path.rpartition(".")[0]


def fields_of(lab: Lab, type_name: str, part: int = 0) -> list[MessageField]:
    """The single values of a message; of a service or an action, those of one of its parts.

    Lists have none: their lengths are the node's own. Raises UnknownInterface.
    """
    sections = re.split(r"^---\s*$", _text(lab, type_name), flags=re.MULTILINE)
    return list(_fields(lab, sections[part], type_name.partition("/")[0]))


def _text(lab: Lab, type_name: str) -> str:
    """Of a type that the course brings, or of one that is installed."""
    package, kind, name = type_name.split("/")
    brought = [folder.parent for folder in packages_of(root())]
    shares = [Path(each, "share") for each in _prefixes()]
    for place in (lab.folder / "interfaces", *brought, *shares):
        file = place / package / kind / f"{name}.{kind}"
        if file.is_file():
            return file.read_text("utf-8")
    raise UnknownInterface(type_name)


def _prefixes() -> list[str]:
    """Where ROS is: what is sourced, and the environment of the wheels."""
    sourced = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    return [*filter(None, sourced), sys.prefix]


def _fields(lab: Lab, text: str, package: str) -> Iterator[MessageField]:
    for line in text.splitlines():
        found = FIELD.match(line.partition("#")[0])
        if not found or found["many"]:
            continue
        if kind := KINDS.get(found["type"]):
            yield MessageField(found["name"], kind)
            continue
        inner = _full(found["type"], package)
        if inner and inner != "builtin_interfaces/msg/Time":
            for each in fields_of(lab, inner):
                yield MessageField(f"{found['name']}.{each.path}", each.kind)


def _full(name: str, package: str) -> str:
    """`Point` is of the same package, and `Header` without one is std_msgs'; "" is no message."""
    if not name.rpartition("/")[2][:1].isupper():
        return ""
    if "/" in name:
        return name if name.count("/") == 2 else name.replace("/", "/msg/")
    return f"std_msgs/msg/{name}" if name == "Header" else f"{package}/msg/{name}"
