"""Which of several files is the newest: by number and time, never by the alphabet."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path

_NUMBER = re.compile(r"(\d+)")
_COUNTED = re.compile(r"[\W_]*v?\d+[\W_]*$", re.IGNORECASE)
"""What a platform or a browser adds to a name that is taken: `-2`, ` (2)`, `_v2`."""
Natural = tuple[str | int, ...]


def natural(text: str) -> Natural:
    """A key to sort by: `topics`, `topics-2`, `topics-10`."""
    pieces = _NUMBER.split(text.casefold())
    return tuple(int(piece) if at % 2 else piece for at, piece in enumerate(pieces))


def newest_first(files: Iterable[Path]) -> list[Path]:
    """Files whose names differ by a number go by it; other names by the time of writing."""
    groups: defaultdict[str, list[Path]] = defaultdict(list)
    for file in files:
        groups[_COUNTED.sub("", file.stem).casefold()].append(file)
    by_time = sorted(groups.items(), key=lambda group: (_written_s(group[1]), group[0]))
    ordered = [file for _, group in by_time for file in sorted(group, key=_by_number)]
    return ordered[::-1]


def _written_s(files: Iterable[Path]) -> float:
    return max(file.stat().st_mtime for file in files)


def _by_number(file: Path) -> tuple[Natural, float]:
    return natural(file.stem), file.stat().st_mtime
