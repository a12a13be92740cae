"""Rooms that nobody has seen before: a node drives the rover in each, and what it did is recorded.

contract.py   what a card says: which rooms, how long, along which wall, before what to stop
seeds.py      the rooms of the student's own choice, and those of a secret
act.py        drives each room in lockstep, or in real time where lockstep cannot tell
record.py     each tick: where the rover was, what it was told, what was near
seen.py       sums over that: how far from a wall, what ground, what stood in its way
"""

from roslings.capabilities.rooms.record import RoomsSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "rooms",
    RoomsSeen,
    words="roslings.capabilities.rooms.contract:WORDS",
    sections="roslings.capabilities.rooms.report:sections",
)
