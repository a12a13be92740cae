"""Drive a student's own nodes through rooms, inside the walls; an experiment of its own.

Each room is driven in lockstep, twice, the second time at half the speed. Where that cannot tell
how the nodes drive, the room is driven in real time, and the evidence says why.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from itertools import islice
from pathlib import Path
from tempfile import TemporaryDirectory

from roslings.capabilities.rooms.contract import RoomsContract
from roslings.capabilities.rooms.drivers import RoomDriver
from roslings.capabilities.rooms.one_drive import Driven, DriveStage
from roslings.capabilities.rooms.record import RoomDriveSeen, RoomsSeen, WhyWall
from roslings.capabilities.rooms.recorded import floor_of, recorded
from roslings.capabilities.rooms.seeds import RoomToDrive
from roslings.capabilities.rooms.side_by_side import HEAVY, SideBySide
from roslings.experiment import Scene
from roslings.lockstep import Believed, DriveBudget, LateDrive, LockstepDrive, drive_twice

LOCKSTEP_AT_ONCE = 2
"""Each takes about one processor: the world and its nodes take turns."""
REAL_TIME_AT_ONCE = 4
"""Each mostly waits, those aside of which lockstep says that they do not."""
TOO_BUSY = "this computer was so busy that a drive through a room did not end in time"
HEAVY_WHYS: tuple[WhyWall, ...] = ("never quiet", "over budget", "ends otherwise")
WHY: dict[str, WhyWall] = {
    "never quiet": "never quiet",
    "over budget": "over budget",
    "nobody follows": "nobody follows",
    "no account": "no account",
}
"""How a drive in lockstep may end that real time must judge."""


def drive_rooms(
    scene: Scene, driver: RoomDriver, rooms: Sequence[RoomToDrive], contract: RoomsContract
) -> None:
    """Drive each room, with nodes that are started for it alone, and write down what was seen.

    The nodes end with each drive: nothing else belongs into the same experiment.

    >>> drive_rooms(scene, NodeDriver(WANDER), own_rooms(ROOMS), ROOMS)
    """
    seen = scene.seen.recording(RoomsSeen)
    with TemporaryDirectory() as folder, SideBySide(scene) as side_by_side:
        stage = DriveStage(scene, driver, contract, Path(folder), side_by_side.called_off)
        try:
            seen.drives += _all_drives(stage, rooms, side_by_side)
        except LateDrive:
            scene.seen.machine_fault = TOO_BUSY
    seen.floors += [floor_of(drive.seed) for drive in seen.drives]


@dataclass(frozen=True)
class TriedRoom:
    """What came of a room in lockstep."""

    room: RoomToDrive
    believed: Believed
    ended: str = ""
    """The process that ended before its time."""

    @property
    def why_wall(self) -> WhyWall | None:
        """Why real time must judge; None where it need not."""
        first = self.believed.first
        if self.believed.is_believed or first.end == "a node ended":
            return None
        if first.end != "done":
            return WHY[first.end]
        return "sleeps" if first.sleepers else "ends otherwise"

    def seen(self, again: Driven | None) -> RoomDriveSeen:
        """The drive that is judged: the one in real time, where there was one."""
        first = self.believed.first
        if again is None:
            found, more = recorded(self.room, first, "lockstep"), {"ended": self.ended}
            return found.model_copy(update=more)
        found = recorded(self.room, again.drive, "wall", first.sleepers)
        doubt = {"why_wall": self.why_wall, "told": first.why}
        return found.model_copy(update={**doubt, "ended": again.ended, "held_s": again.held_s})


def _all_drives(
    stage: DriveStage, rooms: Sequence[RoomToDrive], side_by_side: SideBySide
) -> Iterator[RoomDriveSeen]:
    """Each room, in its order. What lockstep cannot tell of in the first, it cannot in any."""
    first, others = rooms[:1], rooms[1:]
    tried = side_by_side.all([partial(_tried, stage, each) for each in first])
    if any(each.why_wall for each in tried):
        tried += [TriedRoom(each, tried[0].believed) for each in others]
    else:
        errands = [partial(_tried, stage, each) for each in others]
        tried += side_by_side.all(errands, threading.Semaphore(LOCKSTEP_AT_ONCE))
    again: dict[RoomToDrive, Driven] = {}
    doubted = iter([each for each in tried if each.why_wall])
    while some := [*islice(doubted, REAL_TIME_AT_ONCE)]:
        again.update(_in_real_time(stage, some, side_by_side))
    yield from (each.seen(again.get(each.room)) for each in tried)


def _tried(stage: DriveStage, room: RoomToDrive) -> TriedRoom:
    """In lockstep: twice, where the first drive can be believed at all."""
    ended: list[str] = []

    def run(budget: DriveBudget) -> LockstepDrive:
        driven = stage.in_lockstep(room, budget)
        ended.append(driven.ended)
        return driven.drive

    with stage.scene.busy():
        return TriedRoom(room, drive_twice(run, stage.budget), ended[0])


def _in_real_time(
    stage: DriveStage, doubted: Sequence[TriedRoom], side_by_side: SideBySide
) -> dict[RoomToDrive, Driven]:
    """Side by side: all nodes start before any drive is timed."""
    rooms = [each.room for each in doubted]
    turns = HEAVY if any(each.why_wall in HEAVY_WHYS for each in doubted) else None
    with ExitStack() as running:
        with stage.scene.starting():
            begun = [running.enter_context(stage.begun(room, simulated=False)) for room in rooms]
        errands = [
            partial(stage.in_real_time, room, each) for room, each in zip(rooms, begun, strict=True)
        ]
        with stage.scene.timed():
            return dict(zip(rooms, side_by_side.all(errands, turns), strict=True))
