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
    why = "The picture shows that you have looked at your own graph."

    @property
    def expected(self) -> str:
        """The picture."""
        return f"{self.path}: {self.wanted}"

    @property
    def measured(self) -> str:
        """What is there."""
        return self.found

    @property
    def hint(self) -> str:
        """How to make it."""
        return f"Run both nodes. In the package's folder: roslings graph --save {self.path}"


@dataclass(eq=False)
class NoPicture(BadPicture):
    """There is no such file."""


@dataclass(eq=False)
class NotAPicture(BadPicture):
    """The file is no image of the asked kind."""


@dataclass(eq=False)
class PictureTooSmall(BadPicture):
    """The image has too few pixels."""


@dataclass(eq=False)
class OneColour(BadPicture):
    """The image shows nothing."""
