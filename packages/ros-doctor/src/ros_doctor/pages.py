"""The page of each check, for `--explain`: kept as Markdown beside the code, one file a theme.

A page starts at a heading `## id` and ends at the next one.
"""

from __future__ import annotations

import re
from pathlib import Path

from ros_doctor.registry import Check

FOLDER = Path(__file__).parent / "pages"


def page_of(check: Check) -> str:
    """Return the text of a check's page, or "" where none is written."""
    text = (FOLDER / f"{check.theme}.md").read_text(encoding="utf-8")
    found = re.search(rf"^## {re.escape(check.id)}\n(.*?)(?=^## |\Z)", text, re.S | re.M)
    return found.group(1).strip() if found else ""
