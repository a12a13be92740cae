"""That the rover was driven to a ball once: an empty file among what a student has done.

`./roslings` then goes on to day 1. Standard library only: it is asked before anything is installed.
"""

from __future__ import annotations

import os
from pathlib import Path

NAME = Path(".roslings") / "rover-reached-the-ball"


def has_reached_a_ball() -> bool:
    """Somebody has driven this student's rover to a ball."""
    try:
        return _file().is_file()
    except OSError:
        return False


def remember_the_ball() -> None:
    """Raises OSError where the workspace cannot be written."""
    _file().parent.mkdir(parents=True, exist_ok=True)
    _file().touch()


def _file() -> Path:
    """In the student's workspace, as roslings.workspace.student has it. Raises OSError."""
    try:
        workspace = Path(os.environ.get("ROSLINGS_WS") or "~/roslings_ws").expanduser()
    except RuntimeError as error:  # a user without a home
        raise OSError(str(error)) from error
    return workspace.absolute() / NAME
