"""What is kept of a drive, and what a page shows of it: a rover is driven here, without ROS."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import pytest
from room_drives import PERIOD_S, bump, drive, straight

from ros2_on_pip.markup import Markup
from roslings.capabilities.rooms.record import RoomsSeen, WhyWall
from roslings.capabilities.rooms.recorded import floor_of, recorded
from roslings.capabilities.rooms.report import room_picture, sections
from roslings.capabilities.rooms.seeds import RoomToDrive
from roslings.capabilities.rooms.seen import covered_m, encounters, wall_distance, way_m
from roslings.evidence import (
    Evidence,
    ExperimentSeen,
    MachineSeen,
    PackageSeen,
    evidence_json,
    read_json,
    thin_json,
)
from roslings.lockstep import LockstepDrive
from roslings.lockstep.driven_rover import DrivenRoomRover, RoomPlan
from roslings.lockstep.record import SleeperSeen, VelocityCommand
from roslings_rover.models.rooms import room_of

ROOM = 17
TO_DRIVE = RoomToDrive(ROOM, chosen=True, side="left")
Steers = Callable[[int], VelocityCommand | None]


def ahead(_: int) -> VelocityCommand:
    """Whatever there is."""
    return VelocityCommand(forward_m_s=0.25, turn_rad_s=0.0)


def for_a_moment(number: int) -> VelocityCommand | None:
    """Then it says nothing any more."""
    return ahead(number) if number < 20 else None


@cache
def driven(steers: Steers, length_s: float = 30.0, seed: int = ROOM) -> LockstepDrive:
    """A drive by these commands."""
    plan = RoomPlan(room=seed, length_s=length_s, noise_seed=seed)
    rover = DrivenRoomRover(plan, 0)
    for number in range(plan.tick_count):
        command = steers(number)
        commands = (command,) if command else ()
        rover.obey(commands)
        rover.step()
        rover.end_tick(commands)
    return rover.record("done", "", 1.0)


# --- a drive -----------------------------------------------------------------------------------


def test_each_tick_is_kept() -> None:
    """Where it was, to the millimetre, and what it was told."""
    told = driven(ahead)
    kept = recorded(TO_DRIVE, told, "lockstep")
    assert (kept.seed, kept.chosen, kept.side, kept.clock) == (ROOM, True, "left", "lockstep")
    assert kept.period_s == PERIOD_S
    assert len(kept.ticks) == len(told.ticks) == 600
    for one, two in zip(told.ticks, kept.ticks, strict=True):
        assert math.dist((one.x_m, one.y_m), (two.x_m, two.y_m)) < 0.001
        assert (two.forward_m_s, two.turn_rad_s) == (0.25, 0.0)
    assert way_m(kept) == pytest.approx(told.way_m, rel=0.05)
    assert 0 < covered_m(kept) <= way_m(kept) + 0.01


def test_who_drives_straight_on_bumps() -> None:
    """The record has the place, and at that tick the hull is at a wall."""
    kept = recorded(TO_DRIVE, driven(ahead), "lockstep")
    assert kept.bumps
    first = kept.bumps[0]
    there = kept.ticks[round(first.time_s / PERIOD_S)]
    assert math.dist((first.x_m, first.y_m), (there.x_m, there.y_m)) < 0.03
    assert there.nearest_m < 0.03
    assert all(tick.nearest_m > -0.005 for tick in kept.ticks)


def test_what_is_on_a_side_is_what_the_room_has_there() -> None:
    """By the room's own walls, at the start, where it looks along x."""
    kept = recorded(TO_DRIVE, driven(ahead), "lockstep")
    first, world = kept.ticks[0], room_of(ROOM).world
    for far_m, angles in ((first.left_m, range(30, 151, 3)), (first.right_m, range(-150, -29, 3))):
        rays = [world.distance(first.x_m, first.y_m, math.radians(each)) for each in angles]
        assert far_m == pytest.approx(min(rays), abs=0.03)


def test_who_falls_silent_has_no_command() -> None:
    """The rover stops by itself, half a second later."""
    kept = recorded(TO_DRIVE, driven(for_a_moment), "lockstep")
    assert kept.ticks[19].forward_m_s == 0.25
    assert {tick.forward_m_s for tick in kept.ticks[20:]} == {None}
    ends = [(tick.x_m, tick.y_m) for tick in kept.ticks[60:]]
    assert len({*ends}) == 1
    assert kept.ticks[25].x_m > kept.ticks[19].x_m


def test_what_moves_is_kept_from_the_hull() -> None:
    """It goes to and fro: now it is near, now far. Nothing is nearer than what is nearest."""
    room = next(seed for seed in range(100) if room_of(seed).tracks)
    kept = recorded(RoomToDrive(room, False, "right"), driven(for_a_moment, 30.0, room), "lockstep")
    apart_m = [tick.moving_m for tick in kept.ticks if tick.moving_m is not None]
    assert len(apart_m) == 600
    assert len({*apart_m}) > 1
    assert all(tick.nearest_m <= (tick.moving_m or 0.0) for tick in kept.ticks)
    assert len(encounters(kept)) < 10


def test_who_slept_is_kept_with_the_drive_in_real_time() -> None:
    """It was seen in lockstep, which was not believed."""
    asleep = SleeperSeen(pid=7, ticks=9, words="It sleeps.", thread="motor")
    kept = recorded(TO_DRIVE, driven(for_a_moment), "wall", [asleep])
    assert [(each.thread, each.ticks) for each in kept.sleepers] == [("motor", 9)]
    assert kept.clock == "wall"


def test_late_ticks_and_refused_commands_are_counted() -> None:
    """They are no ticks of their own."""
    told = driven(for_a_moment)
    late = tuple(each.model_copy(update={"late": n < 3}) for n, each in enumerate(told.ticks))
    odd = told.model_copy(update={"ticks": late, "refused_commands": 4, "stall_s": 0.12345})
    kept = recorded(TO_DRIVE, odd, "wall")
    assert (kept.late_ticks, kept.refused_commands, kept.stall_s) == (3, 4, 0.123)


def test_a_command_that_is_no_number_is_refused() -> None:
    """The rover goes on as before, and no tick has it."""

    def odd(number: int) -> VelocityCommand:
        turn_rad_s = math.nan if number % 2 else 0.0
        return VelocityCommand(forward_m_s=0.25, turn_rad_s=turn_rad_s)

    told = driven(odd, 2.0)
    kept = recorded(TO_DRIVE, told, "lockstep")
    assert kept.refused_commands == 20
    assert [tick.forward_m_s for tick in kept.ticks] == [0.25, None] * 20


def test_a_wall_beside_the_rover_is_seen() -> None:
    """From where it stands by a wall to the left: as far as the room says."""
    kept = recorded(TO_DRIVE, driven(ahead), "lockstep")
    nearest_m = min(tick.left_m for tick in kept.ticks)
    found = wall_distance(kept, "left", nearest_m, 0.01)
    assert found
    assert found.mean_m >= nearest_m


# --- evidence ----------------------------------------------------------------------------------


def evidence_of(part: RoomsSeen) -> Evidence:
    """Of a grading that drives."""
    seen = ExperimentSeen(name="own", clock="wall", parts={"rooms": part})
    machine = MachineSeen(
        roslings="", ros_distro="", rmw="", python="", platform="", isolation="namespace"
    )
    package = PackageSeen(name="it", folder="it", build_type="ament_python")
    return Evidence(lab="it", seed=0, machine=machine, package=package, experiments={"own": seen})


def rooms_seen(count: int = 1) -> RoomsSeen:
    """So many drives in one room, and its floor."""
    kept = recorded(TO_DRIVE, driven(ahead), "lockstep", [SleeperSeen(pid=7, ticks=9, words="")])
    return RoomsSeen(drives=[kept] * count, floors=[floor_of(ROOM)])


@pytest.mark.parametrize("written", [evidence_json, thin_json])
def test_evidence_is_read_as_it_was_written(written: Callable[[Evidence], bytes]) -> None:
    """Each list in columns, and each number as it was."""
    part = rooms_seen(5)
    assert read_json(written(evidence_of(part))).experiments["own"].part(RoomsSeen) == part


def test_five_rooms_of_a_minute_take_little_room() -> None:
    """In columns a tick takes some bytes; evidence of a class is sent about."""
    kept = recorded(TO_DRIVE, driven(ahead, 60.0), "lockstep")
    part = RoomsSeen(drives=[kept] * 5, floors=[floor_of(ROOM)] * 5)
    ticks = 5 * len(kept.ticks)
    assert ticks == 6000
    assert len(thin_json(evidence_of(part))) < 60 * ticks


def test_a_floor_is_the_room() -> None:
    """Its walls, and all that stands; what moves is no part of it."""
    for seed in range(12):
        floor, room = floor_of(seed), room_of(seed)
        inside = room.world.room
        assert floor.inside == (inside.west_m, inside.south_m, inside.east_m, inside.north_m)
        assert len(floor.boxes) + len(floor.circles) == len(room.world.obstacles)
        west_m, south_m, east_m, north_m = floor.inside
        assert west_m < 0 < east_m
        assert south_m < 0 < north_m


# --- the page ----------------------------------------------------------------------------------


def test_a_picture_has_the_way_and_each_bump() -> None:
    """And what stands in the room."""
    part = rooms_seen()
    (kept,), (floor,) = part.drives, part.floors
    picture = room_picture(floor, kept)
    assert isinstance(picture, Markup)
    assert picture.count('class="told"') == len(kept.bumps) > 0
    assert picture.count('class="true"') == 1
    assert picture.count('class="grid"') == 1 + len(floor.boxes) + len(floor.circles)
    assert f"bumped {len(kept.bumps)} times" in picture
    assert "nan" not in picture


def test_a_picture_of_a_drive_without_ticks_is_the_room() -> None:
    """As where the node ended before its room was there."""
    picture = room_picture(floor_of(ROOM), drive())
    assert 'class="true' not in picture
    assert 'class="grid"' in picture


def test_a_long_way_has_no_more_points_than_a_picture_needs() -> None:
    """The last one is always there: it is where the rover ends."""
    picture = room_picture(floor_of(ROOM), drive(straight(6000, 0.0001)))
    (path,) = (line for line in picture.split("<path") if 'class="true"' in line)
    assert 300 < path.count("L") <= 401


@pytest.mark.parametrize(
    ("why", "words"),
    [(None, "in lockstep"), ("over budget", "judged in real time: your node computes too long")],
)
def test_a_page_has_a_row_for_each_drive(why: WhyWall | None, words: str) -> None:
    """Its room, its way, its bumps, and by which clock."""
    part = rooms_seen()
    kept = part.drives[0].model_copy(update={"why_wall": why, "bumps": [bump(1.0)] * 3})
    (page,) = sections(evidence_of(part.model_copy(update={"drives": [kept] * 2})))
    assert page.count("<td>17</td>") == 2
    assert page.count("<td>3</td>") == 2
    assert page.count(words) == 2
    assert page.count("<svg") == 2


def test_without_drives_there_is_no_section() -> None:
    """Other labs' pages stay as they are."""
    assert [*sections(evidence_of(RoomsSeen()))] == []
