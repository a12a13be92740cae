"""A rover in a room: what moves around it, and what a bump is."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from roslings_rover.models.differential_drive import Motion, Pose
from roslings_rover.models.rooms import SeededRoom, Track, room_of
from roslings_rover.models.world import Box, Circle, World
from roslings_rover.rover.in_room import (
    GIVES_UP_S,
    KEEPS_AWAY_M,
    STANDS_S,
    GoingThing,
    RoomRover,
)
from roslings_rover.rover.rover import Rover

TRACK = Track((2.0, 1.5), (2.0, -1.5), 0.2, 0.25, rests_home_s=1.0, rests_away_s=0.5)
HALL = World(Box(-4.0, -4.0, 4.0, 4.0), (Box(3.0, -4.0, 3.5, 4.0),))
DT_S = 0.02


def rover_in_hall(*tracks: Track) -> RoomRover:
    """A wall ahead, 3 m away, and what moves."""
    return RoomRover(SeededRoom(0, "boxes", HALL, tracks))


def drive(rover: RoomRover, motion: Motion, for_s: float) -> None:
    """Say the same again and again, as a node does."""
    for _ in range(round(for_s / DT_S)):
        rover.drive(motion)
        rover.step(DT_S)


# --- bumps ---------------------------------------------------------------------------------------


def test_a_bump_is_counted_once_and_stops_the_rover() -> None:
    """It stands for a moment whatever it is told, wheels too; then it follows again."""
    rover = rover_in_hall()
    drive(rover, Motion(0.5), 5.5)
    assert rover.bumps == []
    while not rover.bumps:
        drive(rover, Motion(0.5), DT_S)
    (bump,) = rover.bumps
    assert bump.pose.x_m == pytest.approx(3.0 - rover.body.radius_m, abs=0.01)
    assert not bump.moving and bump.time_s == pytest.approx(rover.time_s, abs=DT_S)
    turned = rover.turned_rad
    drive(rover, Motion(-0.5, 1.0), STANDS_S - 2 * DT_S)
    assert rover.stands_still and rover.turned_rad == turned and rover.pose == bump.pose
    drive(rover, Motion(-0.5), 1.0)
    assert rover.pose.x_m < bump.pose.x_m - 0.3
    assert rover.bumps == [bump]


def test_to_push_on_is_no_second_bump() -> None:
    """Nor is a turn in touch; only what was left can be run into again."""
    rover = rover_in_hall()
    drive(rover, Motion(0.5), 12.0)
    drive(rover, Motion(0.5, 0.8), 3.0)
    assert len(rover.bumps) == 1
    rover.pose = Pose(rover.pose.x_m, rover.pose.y_m, 0.0)
    drive(rover, Motion(-0.5), 2.0)
    drive(rover, Motion(0.5), 4.0)
    assert len(rover.bumps) == 2


def test_what_it_was_told_last_is_what_it_does_afterwards() -> None:
    """One command, and no other: it stands, and then turns on the spot as it was told."""
    rover = rover_in_hall()
    drive(rover, Motion(0.5), 6.5)
    rover.drive(Motion(0.0, 1.0))
    rover.step(STANDS_S + 1.5)
    assert rover.pose.heading_rad > 0.5


def test_the_plain_rover_counts_nothing_and_goes_on() -> None:
    """Bumps are a room's; the course's own rover turns on at a wall, as always."""
    rover = Rover(HALL)
    rover.drive(Motion(0.5, 0.05))
    rover.step(8.0)
    assert rover.touches and not hasattr(rover, "bumps")


# --- what moves ----------------------------------------------------------------------------------


def test_it_goes_to_and_fro_and_rests_at_both_ends() -> None:
    """By its speed, for ever."""
    rover = rover_in_hall(TRACK)
    seen = []
    for _ in range(round(60.0 / DT_S)):
        rover.step(DT_S)
        seen.append(rover.world.moving[0].y_m)
    there_s = TRACK.length_m / TRACK.speed_m_s
    round_s = 2 * there_s + TRACK.rests_home_s + TRACK.rests_away_s
    assert max(seen) == pytest.approx(1.5) and min(seen) == pytest.approx(-1.5)
    rests = sum(y_m == pytest.approx(1.5) for y_m in seen) * DT_S
    assert rests == pytest.approx(TRACK.rests_home_s * 60.0 / round_s, abs=1.5)
    fastest = max(abs(b - a) for a, b in pairwise(seen)) / DT_S
    assert fastest == pytest.approx(TRACK.speed_m_s, rel=0.01)


def test_the_scan_sees_it_come() -> None:
    """A beam that was long is short while it passes."""
    rover = rover_in_hall(TRACK)
    ahead = [rover.scan()[0] for _ in range(400) if rover.step(0.05) is None]
    assert min(ahead) == pytest.approx(1.8, abs=0.05) and max(ahead) > 2.9


def test_it_never_touches_a_rover_that_stands() -> None:
    """It waits, and then turns round: a touch is always the rover's own."""
    rover = rover_in_hall(TRACK)
    rover.pose = Pose(2.0, 0.0, 0.0)
    nearest, turned = math.inf, False
    for _ in range(round(60.0 / DT_S)):
        rover.step(DT_S)
        (thing,) = rover.world.moving
        nearest = min(nearest, thing.gap(2.0, 0.0) - rover.body.radius_m)
        turned = turned or (nearest < 0.2 and thing.y_m > 1.4)
        assert thing.y_m > 0
    assert KEEPS_AWAY_M <= nearest < KEEPS_AWAY_M + 0.02
    assert turned and rover.bumps == []


def test_who_drives_into_it_has_bumped_into_something_that_moves() -> None:
    """While it waits for the rover."""
    rover = rover_in_hall(TRACK)
    rover.pose = Pose(2.0, -0.5, math.pi / 2)
    while rover.world.moving[0].y_m > 1.0:
        rover.step(DT_S)
    drive(rover, Motion(0.3), 3.0)
    assert [bump.moving for bump in rover.bumps] == [True]


def test_one_that_waited_goes_on_when_the_way_is_free() -> None:
    """Sooner than it gives up."""
    thing = GoingThing(TRACK)
    for _ in range(round((TRACK.rests_home_s + 2.0) / DT_S)):
        thing.step(DT_S, Circle(9, 9, 0.12))
    y_m = thing.shape.y_m
    for _ in range(round(GIVES_UP_S / 2 / DT_S)):
        thing.step(DT_S, Circle(2.0, y_m - 0.4, 0.12))
    assert thing.shape.y_m > y_m - 0.1
    for _ in range(round(2.0 / DT_S)):
        thing.step(DT_S, Circle(9, 9, 0.12))
    assert thing.shape.y_m < y_m - 0.4


@pytest.mark.parametrize("seed", range(3))
def test_the_same_commands_are_the_same_drive(seed: int) -> None:
    """Bumps, places and scans, in two rovers of one room."""

    def driven() -> tuple[object, ...]:
        rover = RoomRover(room_of(seed), seed=5)
        for turn in (0.3, -0.6, 0.0, 1.0):
            drive(rover, Motion(0.4, turn), 5.0)
        return rover.pose, tuple(rover.bumps), rover.world, tuple(rover.scan())

    assert driven() == driven()
