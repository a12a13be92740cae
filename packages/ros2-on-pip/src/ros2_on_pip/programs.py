"""How an executable of a package is started, and with which environment."""

from __future__ import annotations

import os
import sys
from pathlib import Path

WHEELS_READY = "_ROS_WHEELS_BOOTSTRAP_COMPLETE"


def command_of(program: Path) -> list[str]:
    """The words that start `program`: our own demo nodes run in this Python."""
    return [str(program)] if os.access(program, os.X_OK) else [sys.executable, str(program)]


def environment_of(program: Path) -> dict[str, str]:
    """Our environment, except where the program's Python is another one than ours.

    The wheels of this Python have told the loader where they lie, and noted that; another Python
    must do so for itself.
    """
    environment = dict(os.environ)
    if WHEELS_READY in environment and not _runs_in_our_python(program):
        del environment[WHEELS_READY]
    return environment


def _runs_in_our_python(program: Path) -> bool:
    python = _interpreter(program)
    return python is None or Path(python).parent == Path(sys.prefix) / "bin"


def _interpreter(program: Path) -> str | None:
    """The Python in the first line of a script; None for other programs."""
    try:
        with program.open("rb") as file:
            first = file.readline(500)
    except OSError:
        return None
    words = first[2:].split() if first.startswith(b"#!") else []
    found = words[0].decode(errors="replace") if words else ""
    return found if "python" in found else None
