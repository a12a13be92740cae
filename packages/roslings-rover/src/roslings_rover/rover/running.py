"""Run the rover, with its map, until Ctrl-C."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path

from roslings_rover.errors import DeviceTrouble
from roslings_rover.remembered import remember_the_ball
from roslings_rover.rover.displays import opened
from roslings_rover.rover.driven import DrivenRover
from roslings_rover.rover.frames import FrameOptions
from roslings_rover.rover.keys import driving
from roslings_rover.rover.made import rover_in
from roslings_rover.rover.map_display import Display, View, shown_until
from roslings_rover.rover.one_rover import rover_of_terminal
from roslings_rover.rover.room_node import node_for
from roslings_rover.rover.rover import Rover
from roslings_rover.rover.words import at_its_end
from roslings_rover.stop_signal import listening

REMEMBERED = "It is written down. End the rover with Ctrl-C; ./roslings says what is next."
NOT_REMEMBERED = "End the rover with Ctrl-C. It cannot be written down: {because}."


class CannotSaveMap(DeviceTrouble):
    """The picture of the map cannot be written there."""

    def __init__(self, file: Path, because: str) -> None:
        super().__init__(f"The map cannot be saved as {file}: {because}. Give another FILE.")


def run(
    view: View = "auto",
    picture: Path | None = None,
    seed: int = 0,
    keys: bool = False,
    listens: bool = False,
    room: int | None = None,
    frames: FrameOptions = FrameOptions(),  # noqa: B008 - it cannot change
) -> Rover:
    """Run the rover until Ctrl-C; returns it as it then is. With `keys`, this terminal drives it.

    One that `listens` shows what others say. `room` is the seed of a room that it is in. Raises
    NoWindow, CannotSaveMap, NoTerminal, NoSeed, RoverInCell.
    """
    picture = picture and _as_typed(picture)
    if picture:
        _require_place_for(picture)
    node = node_for(rover_in(room, seed), frames, by_keys=keys, listens=listens)
    with rover_of_terminal(), driving(keys) as look, node, listening() as asked:
        with opened(view, node) as display:
            _go_on(node, display, asked, look)
        print("", *at_its_end(node, "The"), sep="\n")
        if picture:
            _save(node.rover, picture)
    return node.rover


def _go_on(
    node: DrivenRover,
    display: Display[DrivenRover],
    asked: threading.Event,
    look: Callable[[], None],
) -> None:
    def turn() -> None:
        look()
        node.turn()
        if node.reached and not node.next_step:
            node.next_step = _remember()

    shown_until(asked, display, node, turn)


def _remember() -> str:
    """Write down that a ball was reached; what to do next."""
    try:
        remember_the_ball()
    except OSError as error:
        return NOT_REMEMBERED.format(because=error.strerror or error)
    return REMEMBERED


def _as_typed(path: Path) -> Path:
    """What was given relative to this folder is told so again."""
    return path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path


def _require_place_for(picture: Path) -> None:
    if picture.suffix.lower() not in (".png", ".svg", ".pdf"):
        raise CannotSaveMap(picture, "its name must end in .png, .svg or .pdf")
    if not picture.parent.is_dir():
        raise CannotSaveMap(picture, f"there is no folder {picture.parent}")
    if picture.is_dir():
        raise CannotSaveMap(picture, "that is a folder")


def _save(rover: Rover, picture: Path) -> None:
    from roslings_rover.rover.picture import save

    try:
        save(rover, picture)
    except OSError as error:
        raise CannotSaveMap(picture, error.strerror or str(error)) from error
    print(f"Saved {picture}")
