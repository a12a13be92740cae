"""What a card says about frames, walls and a map, and its rows in task.md."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

from pydantic import Field

from roslings.capability import Row, Words
from roslings.course.contract import Contract, Expected, NodeWords
from roslings.course.kinds import Kind

FRAME = r"^[a-z][a-z0-9_]*$"


class WallsContract(Contract):
    """Points on walls, for each scan."""

    answered: Annotated[float, Kind.LEAST] = Field(gt=0, description="The part of all scans")
    off_m: Annotated[float, Kind.MOST] = Field(
        gt=0, description="How far from the walls the points of one scan are, in the mean"
    )


class MapContract(Contract):
    """A grid of cells."""

    cell_m: Annotated[float, Expected] = Field(gt=0, description="The side of a cell")
    right: Annotated[float, Kind.LEAST] = Field(
        gt=0, description="The part of the cells that are right, of each kind"
    )


class TreeContract(Contract):
    """Three frames, from the one that is fixed to the one that measures."""

    odometry: Annotated[str, Expected] = Field(pattern=FRAME, description="Does not move")
    body: Annotated[str, Expected] = Field(pattern=FRAME, description="Of the rover")
    laser: Annotated[str, Expected] = Field(pattern=FRAME, description="On the rover")
    walls: WallsContract
    map: MapContract


class FramesWords(NodeWords):
    """What a card may say of a node."""

    frames: TreeContract | None = None


def rows(node: FramesWords) -> Iterable[Row]:
    """The steps of the tree, and how exact all of it is."""
    if tree := node.frames:
        yield "says on `/tf_static`", f"where `{tree.laser}` is in `{tree.body}`"
        yield "says on `/tf`", f"where `{tree.body}` is in `{tree.odometry}`"
        yield "each step", "is right to a millimetre and a thousandth of a radian"
        yield (
            "walls",
            f"for {tree.walls.answered:.0%} of the scans whose place can be known, at least; off by"
            f" {tree.walls.off_m:g} m at most, in the mean of a scan",
        )
        yield "a cell of the map", f"{tree.map.cell_m:g} m wide; 100, 0 or -1"
        yield "100", "at least one point on a wall lies in the cell"
        yield "0", "a beam went through it to its wall, and no point on a wall lies in it"
        yield "-1", "nothing is known of it"
        yield "of each kind", f"{tree.map.right:.0%} of the cells are right, at least"


WORDS = Words(node=FramesWords, interface=rows)
