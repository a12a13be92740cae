"""Which rooms are driven: the student's; secret ones where an instructor has a secret."""

from __future__ import annotations

import os

from graders.wander.fair import BUSY, FAIR
from roslings.capabilities.rooms.contract import RoomsContract
from roslings.capabilities.rooms.seeds import SECRET, RoomToDrive, own_rooms, secret_rooms


def rooms_to_drive(contract: RoomsContract, seed: int) -> list[RoomToDrive]:
    """The card says how many there are of either kind. Secret ones are fair, and two are busy."""
    if os.environ.get(SECRET):
        return secret_rooms(contract, seed, FAIR, BUSY)
    return own_rooms(contract)
