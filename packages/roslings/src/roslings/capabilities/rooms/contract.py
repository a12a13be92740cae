"""What a card says about rooms that a node drives in, and its rows in task.md."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Annotated

from pydantic import Field

from roslings.capability import Row, Words
from roslings.course.contract import Contract, Expected, NodeWords, Stimulus
from roslings.course.kinds import Kind

SEEDS = 1 << 64
Seed = Annotated[int, Field(ge=0, lt=SEEDS)]


class WallContract(Contract):
    """A wall that the rover is to follow, and how closely."""

    side_parameter: Annotated[str, Expected] = Field(
        pattern=r"^[a-z][a-z0-9_]*$", description="The parameter that is `left` or `right`"
    )
    at_m: Annotated[float, Expected] = Field(gt=0, description="From the laser to the wall")
    mean_off_m: Annotated[float, Kind.MOST] = Field(
        gt=0, description="The mean of how much nearer or farther it is"
    )
    p95_off_m: Annotated[float, Kind.MOST] = Field(
        gt=0, description="95 of 100 times it is off by no more than this"
    )


class StopBeforeContract(Contract):
    """What the rover does before something that moves into its way."""

    from_m: Annotated[float, Kind.LEAST] = Field(
        gt=0, description="It stands before the thing is nearer to its hull than this"
    )


class RoomsContract(Contract):
    """Rooms that a node drives the rover in: each whole number of 64 bits is one."""

    own: Annotated[tuple[Seed, ...], Stimulus] = Field(
        default=(), description="Those that a check takes where the student chooses none"
    )
    secret: Annotated[int, Stimulus] = Field(
        default=0, ge=0, le=20, description="So many more, which nobody can know before"
    )
    drives_s: Annotated[float, Stimulus] = Field(
        default=60.0, gt=0, le=300, description="In each, in robot time"
    )
    covers_m: Annotated[float | None, Kind.LEAST] = Field(
        default=None, gt=0, description="So long a way the rover goes, without driving in circles"
    )
    wall: WallContract | None = None
    stops: StopBeforeContract | None = None


class RoomWords(NodeWords):
    """What a card may say of a node."""

    rooms: RoomsContract | None = None


def rows(node: RoomWords) -> Iterable[Row]:
    """Which rooms, and what is asked for in each."""
    if rooms := node.rooms:
        yield "drives in", f"{_which(rooms)}; {rooms.drives_s:g} s in each"
        yield from _asked(rooms)


def _which(rooms: RoomsContract) -> str:
    own, secret = len(rooms.own), rooms.secret
    if own and secret:
        return f"rooms: {own} that you choose, and {secret} that nobody has seen"
    return f"rooms: {own} that you choose" if own else f"rooms: {secret} that nobody has seen"


def _asked(rooms: RoomsContract) -> Iterator[Row]:
    if wall := rooms.wall:
        yield (
            "follows a wall",
            f"at {wall.at_m:g} m from the laser, on the side that `{wall.side_parameter}` says"
            f" (`left` or `right`); off by {wall.mean_off_m:g} m in the mean, and by"
            f" {wall.p95_off_m:g} m in 95 of 100 cases, at most",
        )
    if rooms.stops:
        yield "stops", f"{rooms.stops.from_m:g} m before something that moves into its way"
    if rooms.covers_m:
        yield "goes", f"{rooms.covers_m:g} m of new ground in each room, at least"


WORDS = Words(node=RoomWords, interface=rows)
