"""What the file colcon.pkg says of a package: its type and its name, and no more is asked."""

from __future__ import annotations

import json
from pathlib import Path

import yaml

from roslings.course.written_yaml import load
from roslings.workspace.bounded import Bookmark, ReaderEnded, read_in_child
from roslings.workspace.errors import reading

WORDS = ("type", "name")
LONGEST_WORD = 100


def said_in(settings: Path) -> dict[str, str | None] | None:
    """Type and name, None where it has none; no answer where it cannot be read."""
    with reading(settings):
        try:
            said = json.loads(read_in_child(lambda bookmark: said_in_child(settings, bookmark)))
        except ReaderEnded:
            return None
    return said if isinstance(said, dict) else None


def said_in_child(settings: Path, bookmark: Bookmark) -> str:
    """The same, as JSON."""
    bookmark.put(settings.name)
    try:
        said = load(settings.read_bytes()) or {}
    except (yaml.YAMLError, ValueError, RecursionError):
        return "null"
    if not isinstance(said, dict):
        return "null"
    return json.dumps({word: _in_words(said.get(word)) for word in WORDS})


def _in_words(value: object) -> str | None:
    """As it is shown; what is no text is named by its kind, for its words have no end."""
    if value is None:
        return None
    return value[:LONGEST_WORD] if isinstance(value, str) else f"({type(value).__name__})"
