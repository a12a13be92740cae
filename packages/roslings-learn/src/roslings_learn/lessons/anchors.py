"""What a link into a lesson or a page may point to."""

from __future__ import annotations

import json
import re
from collections.abc import Collection
from functools import cache
from pathlib import Path

from roslings_learn.lessons.rules.prose import slug

FENCE, HEADING = re.compile(r"```.*?```", re.S), re.compile(r"^#{1,4} (.+)$", re.M)
LABEL = re.compile(r"^\(([\w-]+)\)=$|\{#([\w-]+)\}|\bid=\"([\w-]+)\"", re.M)


def anchors_of(page: Path) -> frozenset[str]:
    """The headings of a page, and what is labelled in it; none where there is no such page."""
    return _anchors_of(page, page.stat().st_mtime_ns) if page.is_file() else frozenset()


@cache
def _anchors_of(page: Path, changed_ns: int) -> frozenset[str]:
    text = page.read_text("utf-8")
    prose = FENCE.sub("", cells_of(text, {"markdown"}) if page.suffix == ".ipynb" else text)
    titles = {slug(title) for title in HEADING.findall(prose)}
    return frozenset(titles | {label for found in LABEL.findall(prose) for label in found if label})


def cells_of(notebook: str, kinds: Collection[str]) -> str:
    """What the cells of these kinds say."""
    cells = (cell for cell in json.loads(notebook)["cells"] if cell["cell_type"] in kinds)
    return "\n\n".join("".join(cell["source"]) for cell in cells)
