"""What the page for teachers says of JupyterHub, for a server in a folder."""

from __future__ import annotations

from pathlib import Path

from roslings.course import root

PAGE = "site/pages/teachers/handing-out.md"


def section() -> str:
    """From its heading to the next."""
    page = (root() / PAGE).read_text("utf-8")
    return page.partition("\n## JupyterHub\n")[2].partition("\n## ")[0]


def block(kind: str, after: str, server: Path) -> str:
    """The first block of code behind some words, with this server's folders."""
    text = section().partition(after)[2].partition(f"```{kind}\n")[2].partition("```")[0]
    assert text, f"{PAGE} has no block of {kind} behind {after!r}"
    return text.replace("/opt/", f"{server}/opt/").replace("/var/", f"{server}/var/")
