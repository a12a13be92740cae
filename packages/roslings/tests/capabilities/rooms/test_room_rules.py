"""Drives that were seen: what is right, what is a fault, what is open."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, get_args

import pytest
from room_drives import AWAY, NEAR, beside, bump, drive, seen, straight, thing, tick

from roslings.capabilities.rooms import demands, faults, reasons
from roslings.capabilities.rooms.contract import StopBeforeContract, WallContract
from roslings.capabilities.rooms.record import RoomDriveSeen, RoomSleeper, WhyWall
from roslings.capabilities.rooms.seen import covered_m
from roslings.evidence import LogLine, ProcessSeen
from roslings.judge import ExperimentView, Fault, Inconclusive, NothingToJudge
from roslings.judge.remarks import begin_remarks, remarks

Demand = Callable[[ExperimentView], None]
WALL = WallContract(side_parameter="side", at_m=0.4, mean_off_m=0.1, p95_off_m=0.2)
STOPS = StopBeforeContract(from_m=0.2)
FOLLOWS, MEETS = demands.follow_its_wall(WALL), demands.stop_before_what_moves(STOPS)
TOUCHES, COVERS = demands.touch_at_most(0), demands.cover(1.0)
DEMANDS = {
    "drives": demands.drive_each,
    "touches": TOUCHES,
    "covers": COVERS,
    "follows": FOLLOWS,
    "stops": MEETS,
}
ALL_WELL = drive(
    [
        *straight(150, left_m=0.41),
        *[tick(1.5, left_m=0.39, **NEAR)] * 40,
        *[tick(1.5 + 0.01 * number, left_m=0.4, **AWAY) for number in range(60)],
    ]
)
STILL = {"forward_m_s": 0.0, "turn_rad_s": 0.0}


def comes_as_near_as(least_m: float, **words: Any) -> RoomDriveSeen:
    """It drives on, and past the thing."""
    nearer = [tick(0.01 * n, **thing(least_m + 0.22 + 0.01 * (29 - n))) for n in range(30)]
    return drive([*nearer, *straight(40, **AWAY)], **words)


def stands_at(gap_m: float, **words: Any) -> RoomDriveSeen:
    """Before the thing, until it is gone."""
    return drive([*[tick(**thing(gap_m + 0.22))] * 20, *straight(40, **AWAY)], **words)


def off_by(*off_m: float, **words: Any) -> RoomDriveSeen:
    """From the wall on the left, tick by tick."""
    return drive(beside(WALL.at_m, *(WALL.at_m + each for each in off_m)), **words)


@dataclass(frozen=True)
class Wrong:
    """A drive in a room, and the words of the fault that is found."""

    demand: Demand
    drive: RoomDriveSeen
    kind: type[Fault]
    expected: str
    measured: str


WRONG = {
    "silent": Wrong(
        demands.drive_each,
        drive(straight(20, 0.0, **STILL)),
        faults.NeverDrives,
        "in room 17 your node lets the rover drive",
        "no command on /cmd_vel moved it",
    ),
    "not finite": Wrong(
        demands.drive_each,
        drive(straight(20, 0.0, **STILL), refused_commands=7),
        faults.NeverDrives,
        "in room 17 your node lets the rover drive",
        "its commands on /cmd_vel were no finite numbers",
    ),
    "another field": Wrong(
        demands.drive_each,
        drive(straight(150), stray="linear.y is nan"),
        faults.SaysMoreThanItDrives,
        "in room 17 all fields of a command are 0, but linear.x and angular.z",
        "in one of its commands linear.y is nan",
    ),
    "bumps": Wrong(
        TOUCHES,
        drive(straight(20), bumps=[bump(3.0), bump(9.0)]),
        faults.BumpsIntoThings,
        "at most 0 bumps in room 17",
        "2 in all; the first one after 3.0 s, at x 1.00 m, y -0.50 m, into something that stands"
        " there",
    ),
    "bumps into what moves": Wrong(
        demands.touch_at_most(1),
        drive(straight(20), bumps=[bump(3.0, moving=True), bump(9.0)]),
        faults.BumpsIntoThings,
        "at most 1 bump in room 17",
        "2 in all; the first one after 3.0 s, at x 1.00 m, y -0.50 m, into something that moves",
    ),
    "stands": Wrong(
        COVERS,
        drive(straight(51)),
        faults.CoversLittle,
        "in room 17 it goes 1 m over new ground, at least",
        "it goes 0.50 m in all",
    ),
    "circles": Wrong(
        COVERS,
        drive([tick(0.1 * (number % 2), 0.1) for number in range(81)]),
        faults.CoversLittle,
        "in room 17 it goes 1 m over new ground, at least",
        "it goes 8.00 m in all, but only 0.35 m of them over new ground",
    ),
    "no wall": Wrong(
        FOLLOWS,
        drive(beside(3.0, 1.5, 0.7, 2.0)),
        faults.NoWallFound,
        "in room 17 a wall on the left, 0.4 m away, give or take 0.2 m",
        "the nearest that it came to one there is 0.70 m",
    ),
    "the other wall": Wrong(
        FOLLOWS,
        drive(beside(*[0.4] * 20), side="right"),
        faults.NoWallFound,
        "in room 17 a wall on the right, 0.4 m away, give or take 0.2 m",
        "the nearest that it came to one there is 9.00 m",
    ),
    "off in the mean": Wrong(
        FOLLOWS,
        off_by(*[0.15] * 40),
        faults.OffTheWall,
        "in room 17 it is 0.4 m from the wall, off by 0.10 m in the mean",
        "it is off by 0.15 m; it was 0.55 m from the wall on its left, in the mean",
    ),
    "off now and then": Wrong(
        FOLLOWS,
        off_by(*[0.0] * 35, *[0.5] * 4),
        faults.OffTheWall,
        "in room 17 it is 0.4 m from the wall, off by 0.20 m in 95 of 100 cases at most",
        "it is off by 0.50 m; it was 0.45 m from the wall on its left, in the mean",
    ),
    "off on the right": Wrong(
        FOLLOWS,
        drive(beside(*[0.4] * 5, *[0.2] * 20, side="right"), side="right"),
        faults.OffTheWall,
        "in room 17 it is 0.4 m from the wall, off by 0.10 m in the mean",
        "it is off by 0.16 m; it was 0.24 m from the wall on its right, in the mean",
    ),
    "runs into what moves": Wrong(
        MEETS,
        comes_as_near_as(0.01, bumps=[bump(1.4, moving=True)]),
        faults.DrivesOn,
        "in room 17 it stands before something that moves into its way is nearer than 0.20 m",
        "after 0.1 s it ran into it",
    ),
    "drives on": Wrong(
        MEETS,
        comes_as_near_as(0.11),
        faults.DrivesOn,
        "in room 17 it stands before something that moves into its way is nearer than 0.20 m",
        "after 0.1 s it drove on, and came as near as 0.11 m",
    ),
    "stands, and drives on": Wrong(
        MEETS,
        drive([*[tick(**thing(0.6))] * 20, *comes_as_near_as(0.11).ticks]),
        faults.DrivesOn,
        "in room 17 it stands before something that moves into its way is nearer than 0.20 m",
        "after 0.1 s it drove on, and came as near as 0.11 m",
    ),
    "stands late": Wrong(
        MEETS,
        stands_at(0.13),
        faults.DrivesOn,
        "in room 17 it stands before something that moves into its way is nearer than 0.20 m",
        "after 0.1 s it stood, 0.13 m before it",
    ),
}


# --- faults ------------------------------------------------------------------------------------


@pytest.mark.parametrize("demand", DEMANDS.values(), ids=DEMANDS)
def test_a_good_drive_is_right(demand: Demand) -> None:
    """It follows, stops, and goes on."""
    demand(seen(ALL_WELL, ALL_WELL))


@pytest.mark.parametrize("wrong", WRONG.values(), ids=WRONG)
def test_what_is_wrong_is_told(wrong: Wrong) -> None:
    """By its kind, in its words, and wherever it stands among the rooms."""
    for drives in ((wrong.drive,), (ALL_WELL, wrong.drive)):
        with pytest.raises(Fault) as found:
            wrong.demand(seen(*drives))
        told = found.value
        assert type(told) is wrong.kind
        assert (told.expected, told.measured) == (wrong.expected, wrong.measured)
        assert told.why and told.hint


def test_each_fault_is_provoked() -> None:
    """Those in the table, and a node that ends, which has a test of its own."""
    here = {each for each in vars(faults).values() if isinstance(each, type)}
    ours = {each for each in here if each.__module__ == faults.__name__}
    assert ours - {wrong.kind for wrong in WRONG.values()} == {faults.EndsInARoom}


def test_who_ends_in_a_room_is_told_with_its_last_words() -> None:
    """And when: the ticks that there are tell it."""
    line = LogLine(arrival_ns=5, source="terminal", text="ValueError: there is no wall")
    process = ProcessSeen(executable="wander", started_ns=0, lines=[line])
    ended = drive(straight(84), ended="wander in room 17")
    with pytest.raises(faults.EndsInARoom) as found:
        demands.drive_each(seen(ended, processes={"wander in room 17": process}))
    assert found.value.measured == "it ended after 4.2 s of robot time"
    assert found.value.log == (line.text,)


def test_a_limit_itself_is_within() -> None:
    """Of each demand."""
    FOLLOWS(seen(off_by(*[0.09] * 40)))
    demands.cover(0.8)(seen(drive(straight(82))))
    MEETS(seen(stands_at(0.21)))
    demands.touch_at_most(2)(seen(drive(straight(20), bumps=[bump(3.0), bump(9.0)])))


# --- what is open ------------------------------------------------------------------------------


@pytest.mark.parametrize("demand", DEMANDS.values(), ids=DEMANDS)
def test_without_a_room_nothing_is_said(demand: Demand) -> None:
    """Neither right nor wrong."""
    with pytest.raises(NothingToJudge, match="no room was driven"):
        demand(seen())


@pytest.mark.parametrize("demand", DEMANDS.values(), ids=DEMANDS)
def test_a_busy_machine_is_nobodys_fault(demand: Demand) -> None:
    """Whatever was seen before a drive that did not end in time."""
    with pytest.raises(Inconclusive, match="so busy that a drive"):
        demand(seen(WRONG["bumps"].drive, machine_fault="so busy that a drive did not end"))


def test_where_nothing_moved_nothing_was_wrong() -> None:
    """And it is told: the same rooms would be the same again."""
    begin_remarks()
    alone = drive(straight(200))
    MEETS(seen(alone, ALL_WELL))
    assert remarks() is None
    MEETS(seen(alone, alone))
    assert remarks() == "nothing that moves came into its way in these rooms"


# --- by which clock ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("demand", "inside", "outside"),
    [
        (FOLLOWS, off_by(*[0.12] * 40), off_by(*[0.13] * 40)),
        (FOLLOWS, off_by(*[0.0] * 37, *[0.24] * 3), off_by(*[0.0] * 37, *[0.26] * 3)),
        (COVERS, drive(straight(83)), drive(straight(79))),
        (MEETS, stands_at(0.17), stands_at(0.15)),
        (MEETS, comes_as_near_as(0.17), comes_as_near_as(0.15)),
    ],
    ids=["mean", "p95", "covers", "stands", "drives on"],
)
def test_in_real_time_limits_are_wider(
    demand: Demand, inside: RoomDriveSeen, outside: RoomDriveSeen
) -> None:
    """By a quarter, and no more: two such drives are never equal. In lockstep they are."""
    with pytest.raises(Fault):
        demand(seen(inside))
    demand(seen(inside.model_copy(update={"clock": "wall"})))
    with pytest.raises(Fault):
        demand(seen(outside.model_copy(update={"clock": "wall"})))


def test_a_touch_is_a_touch_by_either_clock() -> None:
    """There is no band."""
    touched = drive(straight(20), bumps=[bump(3.0)], clock="wall")
    with pytest.raises(faults.BumpsIntoThings):
        TOUCHES(seen(touched))


@pytest.mark.parametrize("held", ["stall_s", "held_s"])
@pytest.mark.parametrize("name", [name for name in WRONG if name != "silent"])
def test_in_real_time_a_fault_may_be_the_computers(name: str, held: str) -> None:
    """Which held the world or the node up. In lockstep nobody is held up; nor is who is right."""
    wrong, by_the_wall = WRONG[name], {"clock": "wall", held: 0.8}
    with pytest.raises(reasons.HeldUpInARoom, match=r"for 0\.80 s; close other programs"):
        wrong.demand(seen(wrong.drive.model_copy(update=by_the_wall)))
    for update in ({**by_the_wall, held: 0.4}, {held: 0.8}):
        with pytest.raises(wrong.kind):
            wrong.demand(seen(wrong.drive.model_copy(update=update)))
    wrong.demand(seen(ALL_WELL.model_copy(update=by_the_wall)))


@pytest.mark.parametrize("why", get_args(WhyWall))
def test_what_was_judged_in_real_time_is_told(why: WhyWall) -> None:
    """Why, once for all rooms, though all is well."""
    begin_remarks()
    doubted = ALL_WELL.model_copy(update={"clock": "wall", "why_wall": why})
    demands.drive_each(seen(doubted, doubted))
    said = remarks()
    assert said
    assert said.count("judged in real time: ") == 1


def test_who_sleeps_is_named() -> None:
    """The main thread, or another one by its name."""
    begin_remarks()
    words = {"clock": "wall", "why_wall": "sleeps"}
    for thread in ("", "motor"):
        sleeper = RoomSleeper(thread=thread, ticks=9)
        demands.drive_each(seen(ALL_WELL.model_copy(update={**words, "sleepers": [sleeper]})))
    said = remarks()
    assert said
    assert "the main thread of your node sleeps on the wall clock" in said
    assert "the thread motor of your node sleeps on the wall clock" in said


def test_of_lockstep_nothing_is_told() -> None:
    """It is the usual way."""
    begin_remarks()
    demands.drive_each(seen(ALL_WELL))
    assert remarks() is None


# --- a share of the points ---------------------------------------------------------------------


def earned(demand: Demand, *drives: RoomDriveSeen) -> float:
    """The share that is left of a check that fails."""
    with pytest.raises(Fault) as fault:
        demand(seen(*drives))
    return fault.value.earned


SHARES = {
    "one of three rooms is silent": (
        demands.drive_each,
        [ALL_WELL, drive(straight(20, 0.0, **STILL)), ALL_WELL],
        2 / 3,
    ),
    "one bump": (TOUCHES, [drive(straight(50), bumps=[bump(1.0)])], 0.5),
    "many bumps": (TOUCHES, [drive(straight(50), bumps=[bump(1.0)] * 9)], 0.0),
    "one bump in one of two rooms": (
        TOUCHES,
        [ALL_WELL, drive(straight(9), bumps=[bump(1.0)])],
        0.75,
    ),
    "twice as far off as allowed": (FOLLOWS, [off_by(*[0.2] * 50)], 0.5),
    "three times as far": (FOLLOWS, [off_by(*[0.1, *[0.31] * 50])], 0.0),
    "no wall in one of two rooms": (FOLLOWS, [ALL_WELL, drive(beside(3.0, *[3.0] * 50))], 0.5),
    "stands before one of two": (MEETS, [stands_at(0.3), comes_as_near_as(0.05)], 0.5),
}


@pytest.mark.parametrize(("demand", "drives", "share"), SHARES.values(), ids=SHARES)
def test_what_is_half_right_keeps_a_share(
    demand: Demand, drives: list[RoomDriveSeen], share: float
) -> None:
    """Whoever does well in two of three rooms is no beginner any more."""
    assert earned(demand, *drives) == pytest.approx(share, abs=0.03)


def test_half_of_the_ground_is_half_of_the_points() -> None:
    """The way over new ground, of the way that is asked for."""
    assert earned(demands.cover(4.0), drive(straight(200))) == pytest.approx(
        covered_m(drive(straight(200))) / 4.0, abs=0.01
    )
