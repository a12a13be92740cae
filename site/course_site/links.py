"""The links that lead away from the site. They are listed on request, and never followed alone."""

from __future__ import annotations

import re
from pathlib import Path

LINK = re.compile(r"https?://[^\s\"'<>)\]\\`]+")


def external_links(source: Path) -> list[str]:
    """Each address once, with the pages that name it."""
    found: dict[str, set[str]] = {}
    for page in sorted([*source.rglob("*.md"), *source.rglob("*.ipynb")]):
        for link in LINK.findall(page.read_text("utf-8")):
            found.setdefault(link.rstrip(".,;:"), set()).add(str(page.relative_to(source)))
    return [f"{link}  ({', '.join(sorted(pages))})" for link, pages in sorted(found.items())]
