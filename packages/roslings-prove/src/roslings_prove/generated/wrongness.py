"""What makes a solution wrong, whoever made it up."""

from __future__ import annotations

from pathlib import Path
from typing import Protocol, TypeVar

from roslings.course import Lab


class Wrongness(Protocol):
    """Something that makes the solution of a lab wrong."""

    @property
    def lab(self) -> Lab:
        """Whose solution."""

    @property
    def name(self) -> str:
        """Short, and the same each time."""

    @property
    def changed(self) -> str:
        """What is wrong, for people."""

    @property
    def diff(self) -> str:
        """The same, and where it stands."""

    def put_into(self, package: Path) -> None:
        """Make a copy of the solution wrong."""


W = TypeVar("W", bound=Wrongness)
