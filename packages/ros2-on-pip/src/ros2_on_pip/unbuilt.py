"""A package that is not found: not built yet, built and not sourced, or not here at all."""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

_NAME = re.compile(r"<name>\s*([^<\s]+)\s*</name>")
_DEPTH = 3
"""Folders below `src` in which a package.xml is looked for."""


def advice(package: str) -> str:
    """What to type so that this terminal knows `package`; empty where no workspace has it."""
    for workspace in _workspaces():
        if _is_built(workspace, package):
            return f"It is built. Source its workspace in this terminal: {_source(workspace)}"
        if _is_written(workspace, package):
            return _build(workspace)
    return ""


def _workspaces() -> Iterator[Path]:
    """Where the student stands, a folder above, and the course's own place."""
    here = Path.cwd()
    yield from (folder for folder in (here, *here.parents) if (folder / "src").is_dir())
    with suppress(RuntimeError):  # a user without a home
        yield Path(os.environ.get("ROSLINGS_WS") or "~/roslings_ws").expanduser()


def _is_built(workspace: Path, package: str) -> bool:
    install = workspace / "install"
    places = (install / package, install)  # each package apart, or all merged
    return (install / "setup.bash").is_file() and any(
        (place / "share" / package / "package.xml").is_file() for place in places
    )


def _is_written(workspace: Path, package: str) -> bool:
    patterns = ("/".join(["src", *"*" * depth, "package.xml"]) for depth in range(_DEPTH + 1))
    manifests = (found for pattern in patterns for found in workspace.glob(pattern))
    return any(_name_in(manifest) == package for manifest in manifests)


def _name_in(manifest: Path) -> str | None:
    try:
        found = _NAME.search(manifest.read_text("utf-8", errors="replace"))
    except OSError:
        return None
    return found[1] if found else None


def _build(workspace: Path) -> str:
    lines = [] if workspace == Path.cwd() else [f"  cd {_typed(workspace)}"]
    return "\n".join(
        [
            "It is not built yet. Build first, then source, in this terminal:",
            *lines,
            "  colcon build",
            "  source install/setup.bash",
        ]
    )


def _source(workspace: Path) -> str:
    file = Path("install", "setup.bash")
    return f"source {file if workspace == Path.cwd() else _typed(workspace / file)}"


def _typed(path: Path) -> str:
    """As a student types it, with ~ for the own home."""
    home = os.environ.get("HOME")
    if not home or not path.is_relative_to(home):
        return shlex.quote(str(path))
    below = path.relative_to(home)
    return f"~/{shlex.quote(str(below))}" if below.parts else "~"
