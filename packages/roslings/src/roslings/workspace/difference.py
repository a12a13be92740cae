"""What changed in a package since the starter, as a unified diff."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from pathlib import Path

from roslings.workspace.errors import reading
from roslings.workspace.sources import files, size

LARGEST_TEXT_BYTES = 1_000_000


def changes_since(starter: Path, package: Path) -> list[str]:
    """Lines of a unified diff from `starter` to `package`, without ends of line.

    Files that are no text are named with their sizes. Lines that differ only in CRLF and LF are
    equal; one line says so. Raises what `sources` raises.
    """
    before, after = files(starter), files(package)
    return [
        line
        for name in sorted(before.keys() | after.keys())
        for line in _changes(name, before.get(name), after.get(name))
    ]


def _changes(name: str, before: Path | None, after: Path | None) -> Iterator[str]:
    old, new = _content(before), _content(after)
    if old == new and (before is None) == (after is None):
        return
    old_text, new_text = _text(old), _text(new)
    if old_text is None or new_text is None:
        yield f"{_verb(before, after)}: {name} ({size(len(new or old))})"
    elif old_text == new_text and before and after:
        yield f"only the ends of lines changed (CRLF and LF): {name}"
    else:
        yield from _text_changes(name, before, after, old_text, new_text)


def _text_changes(
    name: str, before: Path | None, after: Path | None, old: list[str], new: list[str]
) -> Iterator[str]:
    titles = (f"starter/{name}" if before else "/dev/null", name if after else "/dev/null")
    lines = list(difflib.unified_diff(old, new, *titles, lineterm=""))
    yield from lines or [f"{_verb(before, after)}: {name} (empty)"]


def _verb(before: Path | None, after: Path | None) -> str:
    if before is None:
        return "added"
    return "removed" if after is None else "changed"


def _content(path: Path | None) -> bytes:
    """The file's bytes; of a very large file its size is enough to tell it from a text."""
    if path is None:
        return b""
    with reading(path), path.open("rb") as file:
        return file.read()


def _text(content: bytes) -> list[str] | None:
    """The lines of a text; None where the bytes are no text that can be compared by lines."""
    if b"\0" in content or len(content) > LARGEST_TEXT_BYTES:
        return None
    try:
        return content.decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        return None
