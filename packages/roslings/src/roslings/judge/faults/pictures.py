"""Faults in a picture."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault


@dataclass(eq=False)
class BadPicture(Fault):
    """The picture is missing, or is none."""

    path: str
    wanted: str
    found: str
    lab: str
    why = "The picture shows that you have looked at your own graph."
    again = " --force"
    """What stands there must be replaced."""
    expected = "{path}: {wanted}"
    hint = (
        "Run your nodes. Then, in one more terminal, in the roslings folder: ./roslings graph"
        " --for {lab}{again}"
    )

    @property
    def measured(self) -> str:
        """What is there."""
        return self.found


@dataclass(eq=False)
class NoPicture(BadPicture):
    """There is no such file."""

    again = ""


@dataclass(eq=False)
class NotAPicture(BadPicture):
    """The file is no image of the asked kind."""


@dataclass(eq=False)
class PictureTooSmall(BadPicture):
    """The image has too few pixels."""


@dataclass(eq=False)
class OneColour(BadPicture):
    """The image shows nothing."""
