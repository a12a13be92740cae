"""The bag of a drive, kept in the workspace: what is not the rover's is never overwritten.

A bag of the rover's has a list of its files beside them. A folder without that list is somebody
else's, and so is one with a file more. An older bag of the rover's goes when the new one is whole.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from itertools import count
from pathlib import Path

from ros2_on_pip.errors import RoslingsError
from ros2_on_pip.typed_paths import quoted, shown
from roslings.workspace.student import workspace_root

NAME = "my_rover_bag"
OF_A_WHOLE_BAG = "metadata.yaml"
"""A recorder writes it last."""
LIST = "files_of_my_rover.txt"
LONGEST_LIST = 64 * 1024
"""Bytes; a bag of a drive has a handful of files."""


class NotOurBag(RoslingsError):
    """Something that is not the rover's lies where its bag would go."""

    def __init__(self, place: Path) -> None:
        super().__init__(
            f"{shown(place)} is there, and your rover did not make it. It stays as it is.\n"
            f"Give it another name, and start again: mv {quoted(place)}"
            f" {quoted(_free_name_beside(place))}"
        )


def bag_place() -> Path:
    """Where the bag of the last drive is."""
    return workspace_root() / NAME


def require_place() -> None:
    """Raises NotOurBag where a bag could not be kept afterwards."""
    if not _may_replace(bag_place()):
        raise NotOurBag(bag_place())


def kept(bag: Path) -> str:
    """Put the bag of a drive in the place of the last one; what to do with it.

    The last one stays where this one is not whole, or the disk refuses it.
    """
    if not (bag / OF_A_WHOLE_BAG).is_file():
        return f"No bag was kept: its recorder did not come to its end.{_of_the_last_one()}"
    try:
        place = _put(bag)
    except OSError as error:
        because = error.strerror or "the disk refuses it"
        return f"No bag was kept: {because}. Free some space, and drive again.{_of_the_last_one()}"
    return (
        f"The bag of this drive: {shown(place)}\n"
        f"Your program of day 9 reads it: ros2 run black_box read_drive {quoted(place)}"
    )


def _put(bag: Path) -> Path:
    """Copy it whole beside its place, then let it change places with the last one."""
    place = bag_place()
    place.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=place.parent, prefix=f".{NAME}-") as room:
        new = Path(room, "new")
        shutil.copytree(bag, new)
        (new / LIST).write_text("".join(f"{name}\n" for name in sorted(_names_in(bag))), "utf-8")
        if not _may_replace(place):  # somebody put it there while the rover drove
            place = _free_name_beside(place)
        elif place.exists():
            place.rename(Path(room, "last"))
        new.rename(place)
    return place


def _may_replace(place: Path) -> bool:
    """Whether nothing is there, or a bag of the rover's and nothing else."""
    if not os.path.lexists(place):
        return True
    if place.is_symlink() or not place.is_dir():
        return False
    try:
        with (place / LIST).open("rb") as file:
            listed = file.read(LONGEST_LIST).decode("utf-8", "replace").splitlines()
        return _names_in(place) <= {LIST, *listed}
    except OSError:
        return False


def _names_in(folder: Path) -> set[str]:
    return {each.name for each in folder.iterdir()}


def _free_name_beside(place: Path) -> Path:
    return next(each for each in _names_beside(place) if not os.path.lexists(each))


def _names_beside(place: Path) -> Iterator[Path]:
    return (place.with_name(f"{place.name}_{number}") for number in count(2))


def _of_the_last_one() -> str:
    place = bag_place()
    return f" The one before is still there: {shown(place)}" if place.is_dir() else ""
