"""How much a group downloads, measured once for each Python (`./roslings pins`)."""

import json
from collections.abc import Iterable
from pathlib import Path

FILE = Path(__file__).with_name("sizes.json")


def read() -> dict[str, dict[str, float]]:
    """Python ("3.12") -> group -> megabytes (10^6 bytes) beside the groups before it."""
    sizes: dict[str, dict[str, float]] = json.loads(FILE.read_text(encoding="utf-8"))
    return sizes


def megabytes(python: tuple[int, int], groups: Iterable[str]) -> float | None:
    """What `groups` download on `python`, or None where nobody has measured it."""
    table = read().get(".".join(map(str, python)), {})
    known = [table.get(group) for group in groups]
    measured = [mb for mb in known if mb is not None]
    return sum(measured) if len(measured) == len(known) else None
