"""Where in a launch file something stands, and what cannot be carried out there."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

from roslings.ros2.problem import Problem

OURS = str(Path(__file__).parent)


@dataclass(frozen=True)
class Place:
    """A line of a launch file."""

    file: Path
    line: int

    def __str__(self) -> str:
        return f"{self.file.name}, line {self.line}"


class BadLaunchFile(Problem):
    """The launch file cannot be carried out as it stands."""

    def __init__(self, place: Place | str, reason: str) -> None:
        super().__init__(f"[ERROR] [launch]: {place}: {reason}")


class NotReadHere(BadLaunchFile):
    """Right in Jazzy, and only the full ROS carries it out."""

    def __init__(self, place: Place | str, what: str, instead: str = "") -> None:
        from roslings.exits import NOT_READ_HERE  # it loads pydantic: most launches need none

        self.exit_code = NOT_READ_HERE
        use = f" Use instead: {instead}" if instead else ""
        super().__init__(
            place, f"{what} is not known here: it needs the full ros2 on Ubuntu 24.04"
            f" (sudo apt install ros-jazzy-ros-base).{use}",
        )  # fmt: skip


def calling_place() -> Place:
    """The line outside this room that is being carried out: the one in the student's file."""
    frame = sys._getframe(1)
    while frame.f_back and frame.f_code.co_filename.startswith((OURS, "<frozen")):
        frame = frame.f_back
    return Place(Path(frame.f_code.co_filename), frame.f_lineno)
