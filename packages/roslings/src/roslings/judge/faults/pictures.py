"""Faults in a picture."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class BadPicture(Fault):
    """The picture is missing, or is none."""

    path: str
    format: str
    least_px: tuple[int, int]
    """Width and height that it has at the least."""
    lab: str
    why = "The picture shows that you have looked at your own graph."
    is_there: ClassVar[bool] = True
    """What stands there must be replaced."""
    expected = "{path}: a {format} of at least {least_px[0]} x {least_px[1]}"
    hint = one_of(
        first="Run your nodes. Then, in one more terminal, in the roslings folder:"
        " ./roslings graph --for {lab}",
        again="Run your nodes. Then, in one more terminal, in the roslings folder:"
        " ./roslings graph --for {lab} --force",
    )

    @property
    def which_hint(self) -> str:
        """Whether one is there already."""
        return "again" if self.is_there else "first"


@dataclass(eq=False)
class NoPicture(BadPicture):
    """There is no such file."""

    is_there = False
    measured = "there is no such file"


@dataclass(eq=False)
class NotAPicture(BadPicture):
    """The file is no image of the asked kind."""

    found: str | None
    measured = one_of(another="it is {found}", none="it is no image")

    @property
    def which_measured(self) -> str:
        """Whether it is an image at all."""
        return "another" if self.found else "none"


@dataclass(eq=False)
class PictureTooSmall(BadPicture):
    """The image has too few pixels."""

    found_px: tuple[int, int]
    measured = "it has {found_px[0]} x {found_px[1]} pixels"


@dataclass(eq=False)
class OneColour(BadPicture):
    """The image shows nothing."""

    measured = "all pixels have one colour"
