"""Demands on drives through rooms. What was driven in real time is judged with bands.

Points are no matter of all or nothing here. Who does well in two of three rooms keeps a share,
and so does who is a little off the wall.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

from ros2_on_pip.rates import LONGEST_STALL_S
from roslings.capabilities.rooms import faults
from roslings.capabilities.rooms.contract import StopBeforeContract, WallContract
from roslings.capabilities.rooms.reasons import (
    HeldUpInARoom,
    InRealTime,
    NothingDriven,
    NothingInItsWay,
)
from roslings.capabilities.rooms.record import RoomDriveSeen, RoomsSeen
from roslings.capabilities.rooms.seen import (
    Encounter,
    WallDistance,
    covered_m,
    encounters,
    said_anything,
    wall_distance,
    way_m,
)
from roslings.judge.demands import require_believable
from roslings.judge.faults import Fault
from roslings.judge.remarks import remark
from roslings.judge.views import Demand, ExperimentView

BAND = 0.25
"""In real time a limit is wider by this part of it: two such drives are never equal."""
NOTHING_AFTER_BUMPS = 2
"""So many bumps too many in a room, and no points are left of it."""
NOTHING_AT_TIMES = 3.0
"""So many times as far from its wall as it may be, and no points are left of a room."""
KEPT_BESIDE_A_STRAY = 0.5
"""Of the points for a drive, where a command says more than the rover can do."""
COMES_WITHIN = 0.5
"""It has come to its wall where it is first off by no more than this part of the distance."""


@dataclass(frozen=True)
class RoomJudged:
    """What is wrong in a room, or at a place in it."""

    share: float
    """Of the points, from 1 on down; nothing is given below 0."""
    fault: Fault | None = None


RIGHT = RoomJudged(1.0)


def drive_each(experiment: ExperimentView) -> None:
    """The nodes drive in each room, to its end. It tells by which clock they were judged."""

    def judged(drive: RoomDriveSeen) -> RoomJudged:
        _say_the_clock(drive)
        if drive.ended:
            log = experiment.labelled(drive.ended).last_lines()
            after_s = len(drive.ticks) * drive.period_s
            return RoomJudged(0.0, faults.EndsInARoom(drive.seed, after_s, log=log))
        if not said_anything(drive):
            return RoomJudged(0.0, faults.NeverDrives(drive.seed, drive.refused_commands))
        if drive.stray:
            return RoomJudged(
                KEPT_BESIDE_A_STRAY, faults.SaysMoreThanItDrives(drive.seed, drive.stray)
            )
        return RIGHT

    _judge_each(experiment, judged)


def touch_at_most(bumps: int) -> Demand[ExperimentView]:
    """So many bumps in a room, and no more: a touch is one by either clock."""

    def judged(drive: RoomDriveSeen) -> RoomJudged:
        more = len(drive.bumps) - bumps
        if more <= 0:
            return RIGHT
        first = drive.bumps[0]
        fault = faults.BumpsIntoThings(
            drive.seed,
            bumps,
            len(drive.bumps),
            first.time_s,
            first.x_m,
            first.y_m,
            "moving" if first.moving else "standing",
        )
        return RoomJudged(1 - more / NOTHING_AFTER_BUMPS, fault)

    return partial(_judge_each, judged=judged)


def cover(least_m: float) -> Demand[ExperimentView]:
    """It goes so far over new ground in each room."""

    def judged(drive: RoomDriveSeen) -> RoomJudged:
        asked_m, found_m = least_m / _wider(drive), covered_m(drive)
        if found_m >= asked_m:
            return RIGHT
        fault = faults.CoversLittle(drive.seed, least_m, found_m, way_m(drive))
        return RoomJudged(found_m / asked_m, fault)

    return partial(_judge_each, judged=judged)


def follow_its_wall(wall: WallContract) -> Demand[ExperimentView]:
    """It keeps its distance from the wall on the side that its parameter said."""
    return partial(_judge_each, judged=partial(_judged_at_its_wall, wall))


def _judged_at_its_wall(wall: WallContract, drive: RoomDriveSeen) -> RoomJudged:
    side, within_m = drive.side or "left", COMES_WITHIN * wall.at_m
    found = wall_distance(drive, side, wall.at_m, within_m)
    if found is None:
        beside_m = [tick.left_m if side == "left" else tick.right_m for tick in drive.ticks]
        nearest_m = min(beside_m, key=lambda each_m: abs(each_m - wall.at_m))
        fault = faults.NoWallFound(drive.seed, side, wall.at_m, within_m, nearest_m)
        return RoomJudged(0.0, fault)
    off = _off_the_wall(drive, wall, found)
    return RoomJudged(_share_at_its_wall(drive, wall, found), off) if off else RIGHT


def _off_the_wall(
    drive: RoomDriveSeen, wall: WallContract, found: WallDistance
) -> faults.OffTheWall | None:
    side, wider = drive.side or "left", _wider(drive)
    if found.mean_off_m > wall.mean_off_m * wider:
        return faults.OffTheWall(
            drive.seed, side, wall.at_m, "mean", wall.mean_off_m, found.mean_off_m, found.mean_m
        )
    if found.p95_off_m > wall.p95_off_m * wider:
        return faults.OffTheWall(
            drive.seed, side, wall.at_m, "p95", wall.p95_off_m, found.p95_off_m, found.mean_m
        )
    return None


def _share_at_its_wall(drive: RoomDriveSeen, wall: WallContract, found: WallDistance) -> float:
    """All within the limits, and less and less up to some times of them."""
    wider = _wider(drive)
    times = max(found.mean_off_m / wall.mean_off_m, found.p95_off_m / wall.p95_off_m) / wider
    return (NOTHING_AT_TIMES - times) / (NOTHING_AT_TIMES - 1)


def stop_before_what_moves(stops: StopBeforeContract) -> Demand[ExperimentView]:
    """Whenever something that moves comes into its way, it stands in time.

    Who met nothing has done nothing wrong, and is told so: the same rooms would be the same again.
    """

    def demand(experiment: ExperimentView) -> None:
        met = [(drive, each) for drive in _drives(experiment) for each in encounters(drive)]
        if not met:
            remark(NothingInItsWay())
            return
        wrong = [(drive, _drives_on(drive, each, stops.from_m)) for drive, each in met]
        _raise_first(
            [(drive, RoomJudged(0.0, fault) if fault else RIGHT) for drive, fault in wrong]
        )

    return demand


def _drives_on(drive: RoomDriveSeen, met: Encounter, from_m: float) -> faults.DrivesOn | None:
    least_m = from_m / _wider(drive)
    if met.bumped:
        return faults.DrivesOn(drive.seed, from_m, met.from_s, "bumped", met.nearest_m)
    if met.stood_m is not None and met.stood_m < least_m:
        return faults.DrivesOn(drive.seed, from_m, met.from_s, "late", met.stood_m)
    if met.nearest_m < least_m:  # it may have stood before: what moves comes no nearer by itself
        return faults.DrivesOn(drive.seed, from_m, met.from_s, "on", met.nearest_m)
    return None


def _judge_each(experiment: ExperimentView, judged: Callable[[RoomDriveSeen], RoomJudged]) -> None:
    """Raises what is wrong in the first room of those with a fault."""
    _raise_first([(drive, judged(drive)) for drive in _drives(experiment)])


def _raise_first(found: Sequence[tuple[RoomDriveSeen, RoomJudged]]) -> None:
    """The first fault. What was right elsewhere keeps its share of the points."""
    earned = sum(max(each.share, 0.0) for _, each in found) / len(found)
    for drive, each in found:
        if each.fault:
            each.fault.earned = round(earned, 3)
            raise _told(drive, each.fault)


def _drives(experiment: ExperimentView) -> Iterator[RoomDriveSeen]:
    """Raises NothingToJudge where no room was driven, Inconclusive where nothing is believed."""
    require_believable(experiment.seen)
    drives = experiment.seen.part(RoomsSeen).drives
    if not drives:
        raise NothingDriven
    yield from drives


def _wider(drive: RoomDriveSeen) -> float:
    return 1 + BAND if drive.clock == "wall" else 1.0


def _told(drive: RoomDriveSeen, fault: Fault) -> Exception:
    """The fault; in real time not where this computer may have made it."""
    held_s = max(drive.stall_s, drive.held_s)
    if drive.clock == "wall" and held_s > LONGEST_STALL_S:
        return HeldUpInARoom(drive.seed, held_s)
    return fault


def _say_the_clock(drive: RoomDriveSeen) -> None:
    """What was judged in real time is told, whatever comes of it."""
    if drive.why_wall:
        thread = drive.sleepers[0].thread if drive.sleepers else ""
        remark(InRealTime(drive.why_wall, thread))
