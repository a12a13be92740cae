"""A rover of parts, built and wired: its node, its programs, and what there is to say of them."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from roslings.experiment.run_folder import run_folder
from roslings_my_rover.chosen import ChosenParts, NoPart
from roslings_my_rover.crew import Crew, working
from roslings_my_rover.drive_bag import NAME
from roslings_my_rover.installing import BrokenPart, build_all
from roslings_my_rover.parts import CABLE, EYES, MAPPER, RoverPart
from roslings_my_rover.robot import MyRover, node_for
from roslings_my_rover.silence import Silent
from roslings_rover.board import Board, Mega
from roslings_rover.board.wire import Wire
from roslings_rover.camera import SocketCamera, SyntheticCamera
from roslings_rover.camera.room_camera import RoomCamera
from roslings_rover.chip import BAUD
from roslings_rover.rover.in_room import RoomRover
from roslings_rover.rover.made import rover_in
from roslings_rover.rover.rover import Rover

LOOK_EVERY_S = 0.2
NOTICE_LASTS_S = 6.0
OF_ROS = (
    "ROS_DOMAIN_ID",
    "ROS_AUTOMATIC_DISCOVERY_RANGE",
    "RMW_IMPLEMENTATION",
    "FASTRTPS_DEFAULT_PROFILES_FILE",
    "FASTDDS_BUILTIN_TRANSPORTS",
)
"""Variables by which the parts and the rover find each other."""


@dataclass(frozen=True)
class RoverOptions:
    """What somebody wants of a rover, besides its parts."""

    follows: bool = False
    keeps_bag: bool = False
    seed: int = 0
    by_keys: bool = False
    room: int | None = None
    """The seed of the room that it is in; None: the course's own room."""
    more_keys: str = ""
    tf: bool = True
    """It says its frames on /tf and /tf_static, where their type is there."""

    @property
    def wanders(self) -> bool:
        """Whether it may drive by itself: who has the keys, or shows it a ball, leads it."""
        return self.room is not None and not (self.by_keys or self.follows)


@dataclass
class Assembled:
    """The rover while it runs: `turn` must be called again and again."""

    node: MyRover
    crew: Crew
    shown: PartsCaption
    board: Board | None
    plugged: bool = True
    _look_s: float = field(default_factory=time.monotonic)

    def turn(self) -> None:
        """Do the next thing that is due, and look after the parts now and then."""
        self.node.turn()
        now_s = time.monotonic()
        if now_s >= self._look_s:
            self._look_at_parts()
            self._look_s = now_s + LOOK_EVERY_S

    def pull(self) -> None:
        """Pull the cable to the board, or plug it in again."""
        if self.board is None:
            self.shown.tell("There is no cable: no bridge is in your rover.")
            return
        self.plugged = not self.plugged
        if self.plugged:
            self.board.plug_in()
        else:
            self.board.unplug()
        self.shown.tell("The cable is plugged in." if self.plugged else "The cable is pulled.")

    def follow(self) -> None:
        """Follow the ball from now on, or no longer."""
        if EYES not in self.crew.parts:
            self.shown.tell("It cannot follow the ball: no eyes are in your rover.")
            return
        self.crew.follow(not self.crew.follows)
        follows = self.crew.follows
        self.shown.tell("It follows the ball." if follows else "It no longer follows the ball.")

    def _look_at_parts(self) -> None:
        self.shown.forget()
        for ended in self.crew.look():
            self.node.connect(self.crew.wiring.robot)
            then = self.node.about_frames if ended.part is MAPPER else ""
            self.shown.tell(f"{ended.line}\n{then}".rstrip())
        gone = {each.program for each in self.crew.ended}
        silent = (each for each in self.node.silent(self.plugged) if each.program not in gone)
        self.shown.parts(self.crew, tuple(silent))


class PartsCaption:
    """What the map says of the parts, and of what has just happened."""

    def __init__(self, node: MyRover, choice: ChosenParts, broken: list[BrokenPart]) -> None:
        self._node, self._choice = node, choice
        self._broken = {each.chosen.part for each in broken}
        self._until_s = 0.0
        self._silent: tuple[Silent, ...] = ()

    def tell(self, words: str) -> None:
        """For some seconds, or until there is other news."""
        self._node.told = self._node.notice = words
        self._until_s = time.monotonic() + NOTICE_LASTS_S

    def forget(self) -> None:
        """What was told is old."""
        if self._until_s and time.monotonic() > self._until_s:
            self._node.told, self._node.notice, self._until_s = "", "", 0.0

    def parts(self, crew: Crew, silent: tuple[Silent, ...] = ()) -> None:
        """A line each, at most 32 columns; of who has just become silent a word besides."""
        known = {each.program for each in self._silent}
        for each in silent[:1]:  # who waits for a silent one is silent, too
            if each.program not in known:
                self.tell(each.line)
        self._silent = silent
        self._node.about_parts = tuple(self._lines(crew))

    def _lines(self, crew: Crew) -> Iterator[str]:
        ended = {each.part for each in crew.ended}
        programs = {each.program for each in self._silent}
        for each in self._choice.there:
            remark = each.remark
            if each.part in self._broken:
                remark = "does not build"
            elif each.part in ended or each.part not in crew.parts:
                remark = "has ended"
            elif not programs.isdisjoint(each.part.programs):
                remark = "is silent"
            elif not crew.runs(each.part):
                remark = remark or "rests: see --room"
            elif each.part is MAPPER:
                remark = remark or self._about_map
            yield f"{each.part.name:8} {remark}".rstrip()
        yield from (each.line for each in self._choice.absent)

    @property
    def _about_map(self) -> str:
        """How its walls look on the map; at most 23 columns."""
        if self._node.no_map:
            return "its /map is no map"
        return "its walls are green" if self._node.drawn_walls else ""


@contextmanager
def assembled(
    choice: ChosenParts,
    wish: RoverOptions,
    building: Callable[[str], None],
    say: Callable[[str], None],
) -> Iterator[Assembled]:
    """Build the parts and start the rover's node; `start`ing its programs is the next step.

    `building` hears which part is built, `say` which one cannot be. Raises NoPart where there is
    nothing to carry, and what a board, a camera or a build raises.
    """
    with ExitStack() as stack:
        home = stack.enter_context(run_folder())
        built, broken = build_all(choice.there, home, building)
        for each in broken:
            say(each.line)
        if not built:
            raise NoPart
        rover = rover_in(wish.room, wish.seed)
        parts: list[RoverPart] = [each.chosen.part for each in built]
        board = stack.enter_context(_board(rover)) if CABLE in parts else None
        device = stack.enter_context(_camera(rover, home)) if EYES in parts else None
        crew = Crew(
            built,
            environment(home),
            home,
            board.name if board else "",
            str(device or ""),
            wish.follows,
            wish.wanders,
            home / NAME if wish.keeps_bag else None,
        )
        node = node_for(
            rover,
            crew.wiring.robot,
            tf=wish.tf,
            by_keys=wish.by_keys,
            more_keys=wish.more_keys,
        )
        stack.enter_context(node)
        yield Assembled(node, crew, PartsCaption(node, choice, broken), board)


@contextmanager
def started(made: Assembled) -> Iterator[None]:
    """Its programs run until the block ends."""
    with working(made.crew):
        made.shown.parts(made.crew)
        yield


def environment(home: Path) -> dict[str, str]:
    """What the parts get besides: where ROS is heard, and a home that is thrown away."""
    found = {name: os.environ[name] for name in OF_ROS if name in os.environ}
    return {**found, "HOME": str(home), "ROS_LOG_DIR": str(home / "log")}


@contextmanager
def _board(rover: Rover) -> Iterator[Board]:
    """The rover's Arduino, on a port of its own; the wheels are this rover's."""
    with Board(Mega(rover), wire=Wire(BAUD)) as board, board.running():
        yield board


@contextmanager
def _camera(rover: Rover, home: Path) -> Iterator[Path]:
    """What the rover sees, behind a path of its own."""
    kind = RoomCamera if isinstance(rover, RoomRover) else SyntheticCamera
    camera = kind(rover.camera_model, encoding="bgr8")
    path = home / "camera"
    with SocketCamera(path, lambda _: camera.look(rover)) as device:
        device.plug_in()
        yield path
