"""Run my rover: its parts are built and started, its map is shown, until Ctrl-C."""

from __future__ import annotations

import os
import shutil
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.typed_paths import shown
from roslings.experiment.run_folder import run_folder
from roslings.report import Progress
from roslings.workspace.student import workspace_root
from roslings_my_rover.chosen import Choice, NoPart
from roslings_my_rover.crew import Crew, working
from roslings_my_rover.hands import TOLD, hands
from roslings_my_rover.installing import Broken, build_all
from roslings_my_rover.parts import CABLE, EYES, Part
from roslings_my_rover.robot import MyRover
from roslings_rover.asked import listening
from roslings_rover.board import Board, Mega
from roslings_rover.board.wire import Wire
from roslings_rover.camera import SocketCamera, SyntheticCamera
from roslings_rover.chip import BAUD
from roslings_rover.rover.displays import Display, View, opened
from roslings_rover.rover.rover import Rover
from roslings_rover.rover.words import position

LOOK_EVERY_S = 0.2
BAG = "my_rover_bag"
NOTICE_LASTS_S = 6.0
OF_ROS = ("ROS_DOMAIN_ID", "ROS_AUTOMATIC_DISCOVERY_RANGE", "RMW_IMPLEMENTATION",
          "FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_BUILTIN_TRANSPORTS")  # fmt: skip
"""Variables by which the parts and the rover find each other."""


@dataclass
class Cable:
    """The cable to the board: pulled and plugged in again by a key."""

    board: Board | None
    tell: Callable[[str], None]
    plugged: bool = True

    def pull(self) -> None:
        """Pull it, or plug it in."""
        if self.board is None:
            self.tell("There is no cable: no bridge is in your rover.")
            return
        self.plugged = not self.plugged
        if self.plugged:
            self.board.plug_in()
        else:
            self.board.unplug()
        self.tell("The cable is plugged in." if self.plugged else "The cable is pulled.")


def run(
    choice: Choice, view: View, keys: bool, follows: bool, seed: int = 0, keeps_bag: bool = False
) -> Rover:
    """Run it until Ctrl-C; returns the rover as it then is. With `keeps_bag`, see `bag_place`.

    Raises NoPart where there is nothing to carry, NoTerminal, NoWindow, and what a board, a
    camera or a build raises.
    """
    with ExitStack() as stack:
        home = stack.enter_context(run_folder())
        with Progress() as progress:
            built, broken = build_all(choice.there, home, progress.step)
        for each in broken:
            print(each.line, flush=True)
        if not built:
            raise NoPart
        rover = Rover(seed=seed)
        parts = [each.chosen.part for each in built]
        board = stack.enter_context(_board(rover)) if CABLE in parts else None
        device = stack.enter_context(_camera(rover, home)) if EYES in parts else None
        crew = Crew(
            built, _environment(home), home, board.name if board else "", str(device or ""),
            follows, home / BAG if keeps_bag else None,
        )  # fmt: skip
        node = MyRover(rover, by_keys=keys, wiring=crew.wiring.robot, more_keys=TOLD)
        show = Shown(node, choice, broken)
        cable = Cable(board, show.tell)
        look = stack.enter_context(hands(keys, show.tell, cable.pull))
        stack.enter_context(node)
        asked = stack.enter_context(listening())
        with working(crew):
            show.parts(crew)
            with opened(view, node) as display:
                _go_on(node, crew, display, asked, look, show)
        print(f"\nYour rover is at {position(node)}.\nIt went {rover.way_m:.2f} m.")
        for ended in crew.ended:
            print(ended.line)
        if crew.bag:
            print(_kept(crew.bag))
    return rover


def bag_place() -> Path:
    """Where the bag of the last drive is."""
    return workspace_root() / BAG


def _kept(bag: Path) -> str:
    """Put the bag in the place of the last one; what to do with it."""
    if not bag.is_dir():
        return "No bag was kept: nothing was said."
    place = bag_place()
    shutil.rmtree(place, ignore_errors=True)
    shutil.move(bag, place)
    return (
        f"The bag of this drive: {shown(place)}\n"
        f"Your program of day 9 reads it: ros2 run black_box read_drive {shown(place)}"
    )


def _environment(home: Path) -> dict[str, str]:
    """What the parts get besides: where ROS is heard, and a home that is thrown away."""
    found = {name: os.environ[name] for name in OF_ROS if name in os.environ}
    return {**found, "HOME": str(home), "ROS_LOG_DIR": str(home / "log")}


def _go_on(
    node: MyRover,
    crew: Crew,
    display: Display,
    asked: threading.Event,
    look: Callable[[], None],
    show: Shown,
) -> None:
    due_s = look_s = time.monotonic()
    while not (asked.is_set() or display.closed):
        look()
        node.turn()
        now_s = time.monotonic()
        if now_s >= look_s:
            _look_at_parts(node, crew, show)
            look_s = now_s + LOOK_EVERY_S
        if now_s >= due_s:
            show.forget()
            display.show(node)
            due_s = now_s + display.every_s


def _look_at_parts(node: MyRover, crew: Crew, show: Shown) -> None:
    for ended in crew.look():
        node.connect(crew.wiring.robot)
        show.tell(ended.line)
        show.parts(crew)


class Shown:
    """What the map says of the parts, and of what has just happened."""

    def __init__(self, node: MyRover, choice: Choice, broken: list[Broken]) -> None:
        self._node, self._choice = node, choice
        self._broken = {each.chosen.part for each in broken}
        self._until_s = 0.0

    def tell(self, words: str) -> None:
        """For some seconds, or until there is other news."""
        self._node.told = self._node.notice = words
        self._until_s = time.monotonic() + NOTICE_LASTS_S

    def forget(self) -> None:
        """What was told is old."""
        if self._until_s and time.monotonic() > self._until_s:
            self._node.told, self._node.notice, self._until_s = "", "", 0.0

    def parts(self, crew: Crew) -> None:
        """A line each; at most 32 columns."""
        ended = {each.part for each in crew.ended}
        self._node.about_parts = tuple(self._lines(crew.parts, ended))

    def _lines(self, there: list[Part], ended: set[Part]) -> Iterator[str]:
        for each in self._choice.there:
            remark = each.remark
            if each.part in self._broken:
                remark = "does not build"
            elif each.part in ended or each.part not in there:
                remark = "has ended"
            yield f"{each.part.name:8} {remark}".rstrip()
        yield from (each.line for each in self._choice.absent)


@contextmanager
def _board(rover: Rover) -> Iterator[Board]:
    """The rover's Arduino, on a port of its own; the wheels are this rover's."""
    with Board(Mega(rover), wire=Wire(BAUD)) as board, board.running():
        yield board


@contextmanager
def _camera(rover: Rover, home: Path) -> Iterator[Path]:
    """What the rover sees, behind a path of its own."""
    camera = SyntheticCamera(rover.eye, encoding="bgr8")
    path = home / "camera"
    with SocketCamera(path, lambda _: camera.look(rover)) as device:
        device.plug_in()
        yield path
