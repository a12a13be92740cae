"""Look at a text that a student hands in; it may be anything."""

from __future__ import annotations

from pathlib import Path

LARGEST_BYTES = 20_000
"""More than anybody writes by hand: what lies behind it is cut off."""


def text_of(file: Path) -> str:
    """The beginning of a file as text; what is none becomes question marks."""
    with file.open("rb") as content:
        return content.read(LARGEST_BYTES).decode("utf-8", errors="replace")
