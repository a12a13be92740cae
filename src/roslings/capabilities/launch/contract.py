"""What a card says about launch files, and its rows in task.md."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from roslings.capability import Row, Words
from roslings.course.contract import Contract, Expected

if TYPE_CHECKING:
    from roslings.course import Card


class LaunchContract(Contract):
    """A launch file of the package, and the executables that it starts."""

    file: Annotated[str, Expected] = Field(pattern=r"^launch/[a-z0-9_]+\.launch\.(xml|yaml|py)$")
    starts: Annotated[tuple[str, ...], Expected]

    @property
    def name(self) -> str:
        """What stands behind `ros2 launch PACKAGE`."""
        return self.file.rpartition("/")[2]


class LaunchWords(Contract):
    """What a card may say of the package."""

    launch: LaunchContract | None = None


def rows(card: Card) -> Iterable[Row]:
    """The launch file, and what it starts."""
    if card.launch:
        starts = " and ".join(f"`{name}`" for name in card.launch.starts)
        yield "launch file", f"`{card.launch.file}`, starts {starts}"


WORDS = Words(card=LaunchWords, package=rows)
