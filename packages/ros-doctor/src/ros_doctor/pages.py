"""The page of each check, for `--explain`: kept as Markdown beside the code, one file a theme.

A page starts at a heading `## id` and ends at the next one.
"""

from __future__ import annotations

import re
from pathlib import Path

from ros_doctor.registry import DoctorCheck
from ros_doctor.texts import template

FOLDER = Path(__file__).parent / "pages"


def page_of(check: DoctorCheck) -> str:
    """Return the text of a check's page in the language that is asked for, or ""."""
    english = english_page_of(check)
    return template(page_id(check), english) if english else ""


def page_id(check: DoctorCheck) -> str:
    """Return the id of that text."""
    return f"doctor.{check.id}.page"


def english_page_of(check: DoctorCheck) -> str:
    """Return it as it was written, or "" where none is."""
    text = (FOLDER / f"{check.theme}.md").read_text(encoding="utf-8")
    found = re.search(rf"^## {re.escape(check.id)}\n(.*?)(?=^## |\Z)", text, re.S | re.M)
    return found.group(1).strip() if found else ""
