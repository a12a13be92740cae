"""Paths as they are shown, and as they are typed in a shell."""

from __future__ import annotations

import shlex
from pathlib import Path


def shown(path: Path) -> str:
    """A path as the student writes it: with ~ for the own home."""
    try:
        home = Path.home()
    except RuntimeError:  # a user without a home
        return str(path)
    if path == home:
        return "~"
    return f"~/{path.relative_to(home)}" if path.is_relative_to(home) else str(path)


def from_here(path: Path) -> str:
    """A path as it is typed in this folder: what was given relative is relative again."""
    here = Path.cwd()
    return str(path.relative_to(here)) if path.is_relative_to(here) else shown(path)


def quoted(path: Path) -> str:
    """A path as it must be typed in a command: quoted where it has spaces."""
    name = shown(path)
    return f"~/{shlex.quote(name[2:])}" if name.startswith("~/") else shlex.quote(name)


def quoted_from_here(path: Path) -> str:
    """The same as it must be typed in a command of this folder."""
    here = Path.cwd()
    return shlex.quote(str(path.relative_to(here))) if path.is_relative_to(here) else quoted(path)
