"""Which rooms a check or a grading is told to drive, before anything is run."""

from __future__ import annotations

import os
from collections.abc import Sequence

from roslings.capabilities.rooms.contract import RoomsContract, RoomWords
from roslings.capabilities.rooms.seeds import OWN, own_rooms
from roslings.course import CourseError, Lab


class LabHasNoRooms(CourseError):
    """Rooms were asked for in a lab whose nodes drive in none."""

    def __init__(self, lab: str, option: str) -> None:
        super().__init__(f"The lab {lab!r} drives in no rooms. Type it again without {option}.")


def rooms_of(lab: Lab) -> list[RoomsContract]:
    """What the card says of rooms, for each node that drives in some."""
    words = (node.of(RoomWords).rooms for node in lab.card.nodes)
    return [each for each in words if each]


def choose_rooms(lab: Lab, seeds: Sequence[str]) -> None:
    """Let the check drive in these rooms, and in no others. Raises LabHasNoRooms, BadRooms."""
    contracts = rooms_of(lab)
    if not contracts:
        raise LabHasNoRooms(lab.name, "--room")
    os.environ[OWN] = " ".join(seeds)
    for each in contracts:
        own_rooms(each)
