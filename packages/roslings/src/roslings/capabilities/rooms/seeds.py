"""Which rooms: those of the student's own choice, and those of a secret."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from random import Random
from types import MappingProxyType

from roslings.capabilities.rooms.contract import RoomsContract
from roslings.capabilities.rooms.record import Side
from roslings.course import CourseError
from roslings_rover.models.rooms import NoSeed, seed_of

OWN = "ROSLINGS_ROOMS"
"""An environment variable: numbers with blanks between, in place of the card's rooms."""
SECRET = "ROSLINGS_ROOM_SECRET"
"""An environment variable: any text. Whoever has the same one gets the same secret rooms."""
SIDES: tuple[Side, ...] = ("left", "right")
NO_BUSY: Mapping[Side, Sequence[int]] = MappingProxyType({})


class BadRooms(CourseError):
    """The environment names no rooms."""


@dataclass(frozen=True)
class RoomToDrive:
    """A room, and the side of the wall that is to be followed in it."""

    seed: int
    chosen: bool
    side: Side


def own_rooms(contract: RoomsContract) -> list[RoomToDrive]:
    """The card's, or those of the student's choice, no more than these. Raises BadRooms."""
    words = os.environ.get(OWN, "").split()
    try:
        seeds = tuple(map(seed_of, words)) or contract.own
    except NoSeed as error:
        raise BadRooms(f"{OWN}: {error}") from None
    if len(seeds) > len(contract.own):
        raise BadRooms(f"{OWN}: {len(seeds)} rooms. A check drives {len(contract.own)} at most.")
    return [*_with_sides(seeds, chosen=True)]


def secret_rooms(
    contract: RoomsContract,
    secret: int | str,
    among: Sequence[int] = (),
    busy: Mapping[Side, Sequence[int]] = NO_BUSY,
) -> list[RoomToDrive]:
    """As many as the card says: of the instructor's secret where there is one, else of this one.

    `among` are the rooms that may be taken, each one once; without it, each number is a room.
    The first ones are `busy`: something moves into the way of who follows the wall on that side.
    Raises ValueError where there are too few.

    >>> secret_rooms(ROOMS, scene.seed)
    """
    base = os.environ.get(SECRET) or str(secret)
    draw = Random(_number(f"rooms of {base}"))
    first = [RoomToDrive(draw.choice(seeds), False, side) for side, seeds in busy.items()]
    taken, count = {room.seed for room in first}, contract.secret - len(first)
    if among:
        seeds = draw.sample([n for n in among if n not in taken], count)
    else:
        seeds = [_number(f"room {each} of {base}") for each in range(count)]
    return [*first, *_with_sides(seeds, chosen=False)]


def _with_sides(seeds: Sequence[int], chosen: bool) -> Iterator[RoomToDrive]:
    """Both sides in turn; which one comes first, the first room decides."""
    first = _number(f"side in {seeds[0]}") if seeds else 0
    for number, seed in enumerate(seeds):
        yield RoomToDrive(seed, chosen, SIDES[(first + number) % len(SIDES)])


def _number(text: str) -> int:
    """64 bits, the same on every computer."""
    return int.from_bytes(sha256(text.encode()).digest()[:8], "big")
