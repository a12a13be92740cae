"""The definition of a message type as a bag carries it: its text, and those of all types in it."""

from __future__ import annotations

import json
from pathlib import Path

from roslings.ros2.interface_text import messages_in
from roslings.ros2.interfaces import file_of, text_of

RULE = "=" * 80


def definition_of(type_name: str) -> str:
    """The text of a type, then each type that it needs, each after a rule and its name."""
    parts = [text_of(type_name)]
    for inner in _needed(type_name, set()):
        parts.append(f"{RULE}\nMSG: {inner.replace('/msg/', '/')}\n{text_of(inner)}")
    return "\n".join(parts)


def _needed(type_name: str, seen: set[str]) -> list[str]:
    """Every message type inside `type_name`, each once."""
    found: list[str] = []
    for inner in messages_in(type_name):
        if inner not in seen:
            seen.add(inner)
            found += [inner, *_needed(inner, seen)]
    return found


def hash_of(type_name: str) -> str | None:
    """The type's hash, which ROS installs beside its definition; None where it is missing."""
    description = Path(file_of(type_name)).with_suffix(".json")
    try:
        hashes = json.loads(description.read_text("utf-8"))["type_hashes"]
    except (OSError, ValueError, KeyError):
        return None
    found = {entry["type_name"]: entry["hash_string"] for entry in hashes}
    text = found.get(type_name)
    return None if text is None else str(text)
