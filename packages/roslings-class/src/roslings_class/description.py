"""What a wheel says of itself on its page: the README, with pictures and links that work there.

In the repository a README shows `../../site/pictures/verdict.svg`. On the page of a package index,
and in `pip show`, there is no folder beside it. Where the students' edition can be read on the web,
`ROSLINGS_ADDRESS` says where, and each path becomes an address. Else a link leaves its words, and a
picture goes. An instructor's own clone is never named: the solutions are in it.
"""

from __future__ import annotations

import os
import posixpath
import re
from collections.abc import Mapping
from pathlib import PurePosixPath
from urllib.parse import quote, urlsplit

VARIABLE = "ROSLINGS_ADDRESS"
_LINK = re.compile(r"(?P<picture>!?)\[(?P<words>[^\]]*)\]\((?P<to>[^()\s]+)\)")
_OWN_LINE = re.compile(r"^!\[[^\]]*\]\([^()\s]+\)\n+", re.MULTILINE)


class NoAddress(ValueError):
    """What stands in ROSLINGS_ADDRESS leads nowhere."""

    def __init__(self, told: str) -> None:
        super().__init__(
            f"{VARIABLE} is {told!r}, which is no address of a repository on the web.\n"
            f"Give the one that students read: {VARIABLE}=https://HOST/OWNER/COURSE, without a "
            "user or a password, or leave it away."
        )


def address(variables: Mapping[str, str] = os.environ) -> str:
    """Where students read the edition on the web, without a slash at the end; empty: nowhere.

    Raises NoAddress.
    """
    told = variables.get(VARIABLE, "").strip()
    if not told:
        return ""
    parts = urlsplit(told)
    plain = parts.scheme in ("https", "http") and parts.hostname and "@" not in parts.netloc
    if not plain or parts.query or parts.fragment or re.search(r"[\s\"'\\<>]", told):
        raise NoAddress(told)
    return told.rstrip("/").removesuffix(".git")


def for_its_page(text: str, folder: PurePosixPath, at: str) -> str:
    """A README of `folder`, for readers who have no folder beside it.

    `at` is the repository's address. GitHub and GitLab show a file of it under `blob/HEAD/`, and
    give it as it is under `raw/HEAD/`.
    """
    if not at:
        text = _OWN_LINE.sub(lambda line: line[0] if _is_absolute(line[0]) else "", text)
    return _LINK.sub(lambda link: _absolute(link, folder, at), text)


def _is_absolute(line: str) -> bool:
    link = _LINK.match(line)
    return bool(link and urlsplit(link["to"]).scheme)


def _absolute(link: re.Match[str], folder: PurePosixPath, at: str) -> str:
    if urlsplit(link["to"]).scheme or link["to"].startswith("#"):
        return link[0]
    if not at:
        return "" if link["picture"] else link["words"]
    path, hash_, part = link["to"].partition("#")
    there = quote(posixpath.normpath(f"{folder}/{path}"))
    shown = "raw" if link["picture"] else "blob"
    return f"{link['picture']}[{link['words']}]({at}/{shown}/HEAD/{there}{hash_}{part})"


def urls(at: str) -> str:
    """The table of addresses for pyproject.toml; empty where there is none."""
    if not at:
        return ""
    return f'\n[project.urls]\nHomepage = "{at}"\nIssues = "{at}/issues"\n'
