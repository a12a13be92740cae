"""Drives through rooms without a node: the rover of the lab wander, and a rule for each scan."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from builtin_interfaces.msg import Time
from sensor_msgs.msg import LaserScan

from roslings.capabilities.rooms import demands
from roslings.capabilities.rooms.contract import RoomWords
from roslings.capabilities.rooms.record import RoomDriveSeen, RoomsSeen
from roslings.capabilities.rooms.recorded import recorded
from roslings.capabilities.rooms.seeds import RoomToDrive
from roslings.course import lab
from roslings.course.files import written
from roslings.evidence import ExperimentSeen
from roslings.judge import ExperimentView, Fault
from roslings.judge.faults import NothingToJudge
from roslings.judge.views import Demand
from roslings.lockstep.driven_rover import NS_PER_S, DrivenRoomRover, RoomPlan
from roslings.lockstep.record import VelocityCommand
from roslings.lockstep.stepping import BEGINS_S
from roslings_rover.rover.messages import laser_scan

WANDER = lab("wander").card.node("wander")
ROOMS = written(WANDER.of(RoomWords).rooms, WANDER.node)
WALL, STOPS = written(ROOMS.wall, WANDER.node), written(ROOMS.stops, WANDER.node)
COVERS_M = written(ROOMS.covers_m, WANDER.node)
Design = Callable[[LaserScan], tuple[float, float]]
CHECKS: dict[str, Demand[ExperimentView]] = {
    "drives": demands.drive_each,
    "touches": demands.touch_at_most(0),
    "covers": demands.cover(COVERS_M),
    "follows": demands.follow_its_wall(WALL),
    "stops": demands.stop_before_what_moves(STOPS),
}
"""As the grader has them."""


def driven(room: RoomToDrive, design: Design) -> RoomDriveSeen:
    """As lockstep does it: a scan, the command for it, and time goes on."""
    plan = RoomPlan(room=room.seed, length_s=ROOMS.drives_s, noise_seed=room.seed)
    rover = DrivenRoomRover(plan, BEGINS_S * NS_PER_S)
    for _ in range(plan.tick_count):
        heard: tuple[VelocityCommand, ...] = ()
        if rover.scans_now:
            seconds, rest_ns = divmod(rover.now_ns, NS_PER_S)
            forward, turn = design(laser_scan(rover.rover, Time(sec=seconds, nanosec=rest_ns)))
            heard = (VelocityCommand(forward_m_s=forward, turn_rad_s=turn),)
            rover.obey(heard)
        rover.step()
        rover.end_tick(heard)
    return recorded(room, rover.record("done", "", wall_s=1.0), "lockstep")


def view_of(drives: Sequence[RoomDriveSeen]) -> ExperimentView:
    """As a check sees them."""
    parts = {"rooms": RoomsSeen(drives=[*drives])}
    return ExperimentView(ExperimentSeen(name="rooms", clock="wall", parts=parts))


def failed(view: ExperimentView) -> dict[str, str]:
    """Each check that fails, with its fault."""
    found = {}
    for name, demand in CHECKS.items():
        try:
            demand(view)
        except Fault as fault:
            found[name] = type(fault).__name__
        except NothingToJudge:
            continue
    return found
