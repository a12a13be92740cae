"""What a bag tells of a message type, so that it can be read where the type is not installed."""

from __future__ import annotations

import json
import os
import sys
from dataclasses import dataclass
from pathlib import Path

RULE = "=" * 80
NO_HASH = "RIHS01_" + 64 * "0"


@dataclass(frozen=True)
class Definition:
    """The text of a type and of each type in it, and the type's hash."""

    text: str = ""
    hash: str = NO_HASH


def definition_of(type_name: str) -> Definition:
    """The definition of e.g. `std_msgs/msg/String`; an empty one where it was not installed.

    ROS installs two files with each type. One is its text. The other is a description that lists
    the hash of the type (REP 2016) and of every type in it.
    """
    try:
        description = json.loads(_file(type_name, ".json").read_text("utf-8"))
        hashes = {each["type_name"]: each["hash_string"] for each in description["type_hashes"]}
        inner = [name for name in hashes if name != type_name]
        return Definition("\n".join([_text(type_name), *map(_part, inner)]), hashes[type_name])
    except (OSError, ValueError, LookupError):
        return Definition()


def _part(type_name: str) -> str:
    return f"{RULE}\nMSG: {type_name.replace('/msg/', '/')}\n{_text(type_name)}"


def _text(type_name: str) -> str:
    return _file(type_name, ".msg").read_text("utf-8")


def _file(type_name: str, ending: str) -> Path:
    """Raises FileNotFoundError, and ValueError for a name that is none."""
    package, kind, name = type_name.split("/")
    for prefix in _prefixes():
        if (file := prefix / "share" / package / kind / (name + ending)).is_file():
            return file
    raise FileNotFoundError(type_name)


def _prefixes() -> list[Path]:
    """Where ROS packages lie: in the sourced folders, else in this very environment."""
    sourced = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    return [*map(Path, filter(None, sourced)), Path(sys.prefix)]
