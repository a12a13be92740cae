"""The measuring process as a fork: what all gradings of a lab need is loaded once, before.

For a process that measures often. It must have no threads of its own.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from contextlib import suppress
from functools import cache
from multiprocessing import get_context
from pathlib import Path

from roslings.arena import Isolation, choose_isolation, kernel, ros_environment
from roslings.course import lab
from roslings.experiment.assignment import Assignment
from roslings.experiment.declare import load_grader
from roslings.experiment.measuring import carry_out
from roslings.probe.beforehand import load_ros

TYPES = re.compile(r'"(\w+/(?:msg|srv|action)/\w+)"')
"""Names of message types in a card."""


@cache
def load_beforehand(name: str, hidden: Path | None = None) -> None:
    """Load rclpy, the middleware, the lab's message types and its graders; choose the walls.

    What cannot be loaded is told by the grading that needs it.
    """
    with suppress(Exception):
        os.environ.update(ros_environment(choose_isolation().wall))
        task = lab(name, hidden)
        load_ros(TYPES.findall(task.card.model_dump_json()))
        for grader in task.graders:
            load_grader(grader)


class Fork:
    """A measuring process that has all that this one has loaded."""

    def __init__(self, assignment: Assignment, walls: Isolation, errors: int) -> None:
        steps, told = os.pipe()
        words = (os.getpid(), assignment, walls, told, errors)
        self._process = get_context("fork").Process(target=_live, args=words)
        self._process.start()
        os.close(told)
        self.stdout = open(steps, encoding="utf-8")  # noqa: PTH123, SIM115

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


def _live(begun_by: int, assignment: Assignment, walls: Isolation, told: int, errors: int) -> None:
    """In the fork, to its end."""
    os.setsid()
    for number, target in ((1, told), (2, errors)):
        os.dup2(target, number)
    os.close(told)
    sys.stdout = open(1, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stderr = open(2, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    os.chdir(assignment.folder)
    walls.enter(assignment.room)
    kernel.die_with_parent()
    if os.getppid() == begun_by:  # the folder's lock tells a fork nothing: it holds it as well
        carry_out(assignment)
