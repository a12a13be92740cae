"""The bag of a sick rover, for the student of a name."""

from __future__ import annotations

from pathlib import Path

from ros2_on_pip.rosbag2.errors import BagError
from roslings_rover.errors import DeviceTrouble
from roslings_rover.models.drives.sick_rover import NotARoverName, sick_rover
from roslings_rover.models.drives.unknown import as_drive
from roslings_rover.rover.black_box import write_drive


class NeedsName(DeviceTrouble):
    """Nobody said whose rover it is."""

    def __init__(self) -> None:
        super().__init__(
            "The faults of the sick rover follow from your name. Type it, as you hand in:\n"
            './roslings rover --sick --name "Ada Lovelace"'
        )


class CannotWriteBag(DeviceTrouble):
    """The bag cannot be written there."""

    def __init__(self, error: BagError) -> None:
        super().__init__(f"{error}\nGive another place: --to FOLDER")


def write_sick_rover(name: str, folder: Path) -> float:
    """Write the bag of this name into a new folder; how many seconds the drive lasts.

    Raises NeedsName, CannotWriteBag.
    """
    try:
        rover = sick_rover(name)
    except NotARoverName:
        raise NeedsName from None
    try:
        write_drive(as_drive(rover.plan, tuple(rover.said)), folder)
    except BagError as error:
        raise CannotWriteBag(error) from error
    return rover.plan.seconds
