"""The rover that somebody drives: in the course's own room, or in one from a seed."""

from __future__ import annotations

from roslings_rover.models.rooms import room_of
from roslings_rover.rover.in_room import RoomRover
from roslings_rover.rover.quick_scanner import QuickScanner
from roslings_rover.rover.rover import Rover


def rover_in(room: int | None, seed: int = 0) -> Rover:
    """`room` is its seed, and `seed` that of the sensors' noise. Raises NoSeed."""
    if room is not None:
        return RoomRover(room_of(room), seed)
    rover = Rover(seed=seed)
    rover.scanner = QuickScanner()
    return rover
