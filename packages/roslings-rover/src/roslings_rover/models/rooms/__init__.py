"""Rooms that nobody has seen before: each whole number of 64 bits is one.

A rover gets from its start to every part of the floor: no way is narrower than `PASSAGE_M`. Things
that move go to and fro. Wherever they are, there is a way past them, of `PAST_M` at least.
"""

from roslings_rover.models.rooms.made import room_of
from roslings_rover.models.rooms.room import (
    IN_WORDS,
    KINDS,
    PASSAGE_M,
    PAST_M,
    Kind,
    MovingWorld,
    SeededRoom,
    Track,
    moving_in,
)
from roslings_rover.models.rooms.seeds import SEEDS, NoSeed, seed_of

__all__ = [
    "IN_WORDS",
    "KINDS",
    "PASSAGE_M",
    "PAST_M",
    "SEEDS",
    "Kind",
    "MovingWorld",
    "NoSeed",
    "SeededRoom",
    "Track",
    "moving_in",
    "room_of",
    "seed_of",
]
