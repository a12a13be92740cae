"""Which rooms are driven: the student's; secret ones where an instructor has a secret."""

from __future__ import annotations

import os

from roslings.capabilities.rooms.contract import RoomsContract
from roslings.capabilities.rooms.seeds import SECRET, RoomToDrive, own_rooms, secret_rooms


def rooms_to_drive(contract: RoomsContract, seed: int) -> list[RoomToDrive]:
    """The card says how many there are of either kind."""
    return secret_rooms(contract, seed) if os.environ.get(SECRET) else own_rooms(contract)
