"""Which rooms: those of the student's own choice, and those of a secret."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from hashlib import sha256
from random import Random

from roslings.capabilities.rooms.contract import RoomsContract
from roslings.capabilities.rooms.record import Side
from roslings.course import CourseError
from roslings_rover.models.rooms import NoSeed, seed_of

OWN = "ROSLINGS_ROOMS"
"""An environment variable: numbers with blanks between, in place of the card's rooms."""
SECRET = "ROSLINGS_ROOM_SECRET"
"""An environment variable: any text. Whoever has the same one gets the same secret rooms."""
SIDES: tuple[Side, ...] = ("left", "right")


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
    contract: RoomsContract, secret: int | str, among: Sequence[int] = ()
) -> list[RoomToDrive]:
    """As many as the card says: of the instructor's secret where there is one, else of this one.

    `among` are the rooms that may be taken, each one once; without it, each number is a room.
    Raises ValueError where there are too few.

    >>> secret_rooms(ROOMS, scene.seed)
    """
    base = os.environ.get(SECRET) or str(secret)
    if among:
        seeds = Random(_number(f"rooms of {base}")).sample(among, contract.secret)
    else:
        seeds = [_number(f"room {each} of {base}") for each in range(contract.secret)]
    return [*_with_sides(seeds, chosen=False)]


def _with_sides(seeds: Sequence[int], chosen: bool) -> Iterator[RoomToDrive]:
    """Both sides in turn; which one comes first, the first room decides."""
    first = _number(f"side in {seeds[0]}") if seeds else 0
    for number, seed in enumerate(seeds):
        yield RoomToDrive(seed, chosen, SIDES[(first + number) % len(SIDES)])


def _number(text: str) -> int:
    """64 bits, the same on every computer."""
    return int.from_bytes(sha256(text.encode()).digest()[:8], "big")
