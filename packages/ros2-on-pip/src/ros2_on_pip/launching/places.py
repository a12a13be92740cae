"""Where in a launch file something stands, and what cannot be carried out there."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.problem import CommandProblem

OURS = str(Path(__file__).parent)


@dataclass(frozen=True)
class LaunchFileLine:
    """A line of a launch file."""

    file: Path
    line: int

    def __str__(self) -> str:
        return f"{self.file.name}, line {self.line}"


class BadLaunchFile(CommandProblem):
    """The launch file cannot be carried out as it stands."""

    def __init__(self, place: LaunchFileLine | str, reason: str) -> None:
        super().__init__(f"[ERROR] [launch]: {place}: {reason}")


class NotReadHere(BadLaunchFile):
    """Right in Jazzy, and only the full ROS carries it out."""

    def __init__(self, place: LaunchFileLine | str, what: str, instead: str = "") -> None:
        from ros2_on_pip.words import NOT_READ_HERE

        self.exit_code = NOT_READ_HERE
        use = f" Use instead: {instead}" if instead else ""
        super().__init__(
            place,
            f"{what} is right in Jazzy, and not in this launch: it needs the full ros2 on"
            f" Ubuntu 24.04 (sudo apt install ros-jazzy-ros-base).{use}",
        )


_standing: list[LaunchFileLine] = []


@contextmanager
def standing_at(place: LaunchFileLine) -> Iterator[None]:
    """What is made inside stands at `place`: an element of XML or YAML, which no frame names."""
    _standing.append(place)
    try:
        yield
    finally:
        _standing.pop()


def calling_place() -> LaunchFileLine:
    """The element that is read, or the line outside this room that is being carried out."""
    if _standing:
        return _standing[-1]
    frame = sys._getframe(1)
    while frame.f_back and frame.f_code.co_filename.startswith((OURS, "<frozen")):
        frame = frame.f_back
    return LaunchFileLine(Path(frame.f_code.co_filename), frame.f_lineno)
