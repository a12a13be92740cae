"""The measuring process: a fork, which has all that its parent has loaded.

It has a session of its own: Ctrl-C in the terminal reaches the command alone, which then asks the
process to end in order. It works in the run's folder, not in the student's: a file `random.py`
there would be imported in Python's place. Whoever forks must have no threads of its own, and must
never have made a node. In the fork, the middleware would be there without its threads, and would
see nobody.
"""

from __future__ import annotations

import os
import subprocess
import sys
from contextlib import suppress
from multiprocessing import get_context

from roslings.arena import Isolation, kernel
from roslings.evidence import PackageSeen
from roslings.experiment.assignment import Assignment
from roslings.experiment.measuring import carry_out


class Fork:
    """A measuring process; it begins when it is told of a package."""

    def __init__(self, assignment: Assignment, walls: Isolation, errors: int) -> None:
        """Its last words go into the file of the descriptor `errors`."""
        steps, told = os.pipe()
        heard, write_end = os.pipe()
        words = (os.getpid(), assignment, walls, (heard, told, errors), (steps, write_end))
        self._process = get_context("fork").Process(target=_live, args=words)
        self._process.start()
        os.close(told)
        os.close(heard)
        self._to_child = open(write_end, "w", encoding="utf-8")  # noqa: PTH123, SIM115
        self.stdout = open(steps, encoding="utf-8")  # noqa: PTH123, SIM115
        """A line of text a step."""

    def tell(self, package: str) -> None:
        """Say what stands in the package's files, as JSON: it is built from now on."""
        with suppress(BrokenPipeError):  # it is gone, and its last words tell why
            self._to_child.write(package)
            self._to_child.close()

    def close(self) -> None:
        """Close our ends of what joins us with it."""
        self.stdout.close()
        with suppress(BrokenPipeError):
            self._to_child.close()

    def poll(self) -> int | None:
        """Its status; None while it runs."""
        return self._process.exitcode

    def wait(self, timeout: float | None = None) -> int:
        """Its status, at its end. Raises subprocess.TimeoutExpired."""
        self._process.join(timeout)
        if self._process.exitcode is None:
            raise subprocess.TimeoutExpired("fork", timeout or 0.0)
        return self._process.exitcode

    def terminate(self) -> None:
        """Ask it to end in order."""
        self._process.terminate()

    def kill(self) -> None:
        """End it at once."""
        self._process.kill()


def _live(
    begun_by: int,
    assignment: Assignment,
    walls: Isolation,
    ends: tuple[int, int, int],
    others: tuple[int, int],
) -> None:
    """In the fork, to its end. `ends` become its standard streams; `others` are its parent's."""
    os.setsid()
    for number, target in enumerate(ends):
        os.dup2(target, number)
    for each in (*ends, *others):
        os.close(each)
    sys.stdout = open(1, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stderr = open(2, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    os.chdir(assignment.folder)
    walls.enter(assignment.room, assignment.sandbox)
    kernel.die_with_parent()
    package = open(0, encoding="utf-8", closefd=False).read()  # noqa: SIM115
    if package and os.getppid() == begun_by:  # else nobody wants to know any more
        carry_out(assignment, PackageSeen.model_validate_json(package))
