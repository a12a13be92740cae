"""One element of a launch file, whichever of the two languages it was written in."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from roslings.exits import NOT_READ_HERE
from roslings.ros2.problem import Problem


@dataclass
class Entity:
    """A tag with its attributes and the elements inside it."""

    tag: str
    file: Path
    line: int
    attributes: dict[str, Any] = field(default_factory=dict)
    children: list[Entity] = field(default_factory=list)

    @property
    def place(self) -> str:
        """Where it stands, for messages."""
        return f"{self.file.name}, line {self.line}"

    def inside(self, tag: str) -> list[Entity]:
        """The elements of one kind inside it."""
        return [child for child in self.children if child.tag == tag]


class BadLaunchFile(Problem):
    """The launch file cannot be carried out as it stands."""

    def __init__(self, place: str, reason: str) -> None:
        super().__init__(f"[ERROR] [launch]: {place}: {reason}")


class NotReadHere(BadLaunchFile):
    """Right in Jazzy, and only the full ROS carries it out."""

    exit_code = NOT_READ_HERE

    def __init__(self, place: str, what: str) -> None:
        super().__init__(
            place, f"{what} is not known here. It needs the full ros2 on Ubuntu 24.04:"
            " sudo apt install ros-jazzy-ros-base",
        )  # fmt: skip
