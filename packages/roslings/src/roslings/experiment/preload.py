"""Load what a lab's gradings need: once in a process that is forked, or while colcon builds."""

from __future__ import annotations

import os
import re
from contextlib import suppress
from functools import cache
from pathlib import Path

from roslings.arena import choose_isolation, ros_environment
from roslings.course import lab
from roslings.course.grader import load_grader
from roslings.probe.preload import load_ros

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
