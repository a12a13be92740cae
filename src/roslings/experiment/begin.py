"""How the measuring process begins: here in a fresh Python, in `forked.py` as a fork.

Either way it has a session of its own: Ctrl-C in the terminal reaches the command alone, which
then asks the process to end in order. It works in the run's folder, not in the student's: a file
`random.py` there would be imported in Python's place.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from typing import IO, Protocol

from roslings.arena import Isolation
from roslings.experiment.assignment import Assignment


class Begun(Protocol):
    """A measuring process, as `subprocess.Popen` has it."""

    @property
    def stdout(self) -> IO[str] | None:
        """A line of text a step."""

    def poll(self) -> int | None:
        """Its status; None while it runs."""

    def wait(self, timeout: float | None = None) -> int:
        """Its status, at its end. Raises subprocess.TimeoutExpired."""

    def terminate(self) -> None:
        """Ask it to end in order."""

    def kill(self) -> None:
        """End it at once."""


Begin = Callable[[Assignment, Isolation, int], Begun]
"""Begin to measure, behind these walls; the last words go into the file of this descriptor."""


def in_a_fresh_python(assignment: Assignment, walls: Isolation, errors: int) -> Begun:
    """It loads what it needs; for a process that measures once."""
    assignment.file.write_text(assignment.model_dump_json(), "utf-8")
    module = [sys.executable, "-m", "roslings.experiment.measuring", str(assignment.file)]
    return subprocess.Popen(
        walls.command(module, assignment.room),
        cwd=assignment.folder,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=errors,
        text=True,
        start_new_session=True,
    )
