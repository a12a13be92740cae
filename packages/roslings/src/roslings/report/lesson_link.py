"""Where a paragraph of a lesson can be opened on this computer."""

from __future__ import annotations

from roslings.course import root

SITE = "build/site/html"
"""Where `./roslings site` builds."""


def link_of(lesson: str) -> str:
    """The address of `days/DAY#heading` in the built site; empty where no site is built."""
    day, _, anchor = lesson.partition("#")
    page = root() / SITE / day / "index.html"
    if not page.is_file():
        return ""
    return page.as_uri() + (f"#{anchor}" if anchor else "")
