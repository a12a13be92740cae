"""Rooms of the lab wander: which are driven, and that more than one design has all points."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import pytest
from builtin_interfaces.msg import Time
from designs import Rule, Waiting, bang_bang, vector_field
from sensor_msgs.msg import LaserScan

from graders.wander.act import rooms_to_drive
from roslings.capabilities.rooms import demands
from roslings.capabilities.rooms.contract import RoomWords
from roslings.capabilities.rooms.record import RoomDriveSeen, RoomsSeen
from roslings.capabilities.rooms.recorded import recorded
from roslings.capabilities.rooms.seeds import OWN, SECRET, RoomToDrive
from roslings.capabilities.rooms.seen import encounters
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
RULES: dict[str, Rule] = {"bang-bang": bang_bang, "vector field": vector_field}


@pytest.fixture(autouse=True)
def nobody_chooses(monkeypatch: pytest.MonkeyPatch) -> None:
    """The card's rooms."""
    monkeypatch.delenv(OWN, raising=False)
    monkeypatch.delenv(SECRET, raising=False)


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


def seen(rule: Rule, side: str = "") -> ExperimentView:
    """It drives in each room, along the wall that is asked for, or always along one side."""
    drives = [
        driven(room, Waiting(rule, side or room.side)) for room in rooms_to_drive(ROOMS, seed=1)
    ]
    parts = {"rooms": RoomsSeen(drives=drives)}
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


# --- which rooms -------------------------------------------------------------------------------


def test_the_cards_rooms_have_walls_on_both_sides() -> None:
    """Both are asked for in each grading."""
    rooms = rooms_to_drive(ROOMS, seed=1)
    assert [room.seed for room in rooms] == [*ROOMS.own]
    assert {room.side for room in rooms} == {"left", "right"}


def test_a_student_chooses_rooms(monkeypatch: pytest.MonkeyPatch) -> None:
    """As the task says it."""
    monkeypatch.setenv(OWN, "7 8 9")
    assert [room.seed for room in rooms_to_drive(ROOMS, seed=1)] == [7, 8, 9]


def test_an_instructors_rooms_are_the_same_for_all(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever a student chooses, and whatever the grading's own seed is."""
    monkeypatch.setenv(SECRET, "harbour")
    rooms = rooms_to_drive(ROOMS, seed=1)
    monkeypatch.setenv(OWN, "7 8 9")
    assert rooms_to_drive(ROOMS, seed=2) == rooms
    assert len(rooms) == ROOMS.secret
    assert not any(room.chosen for room in rooms)


# --- designs -----------------------------------------------------------------------------------


@pytest.mark.parametrize("rule", RULES.values(), ids=RULES)
def test_another_design_has_all_points(rule: Rule) -> None:
    """And something that moves has been in its way."""
    view = seen(rule)
    assert failed(view) == {}
    assert any(map(encounters, view.seen.part(RoomsSeen).drives))


@pytest.mark.parametrize("side", ["left", "right"])
def test_who_follows_one_side_only_does_not(side: str) -> None:
    """The card's rooms ask for both."""
    assert failed(seen(bang_bang, side)).keys() == {"follows"}


def test_who_stands_covers_nothing() -> None:
    """It turns a little, so it drives."""
    stands: Rule = partial(_turns, 0.2)
    assert failed(seen(stands))["covers"] == "CoversLittle"


def _turns(turn_rad_s: float, _: dict[int, float]) -> tuple[float, float]:
    return 0.0, turn_rad_s
