"""What is reckoned from the ticks of a drive: way, ground, distance from a wall, encounters."""

from __future__ import annotations

import math

import pytest
from room_drives import AWAY, FREE_M, NEAR, PERIOD_S, beside, bump, drive, straight, thing, tick

from roslings.capabilities.rooms.record import RoomTick, Side
from roslings.capabilities.rooms.seen import (
    CELL_M,
    HULL_M,
    LOOKS_AHEAD_M,
    STANDS_S,
    covered_m,
    encounters,
    is_in_the_way,
    mean,
    quantile,
    said_anything,
    wall_distance,
    way_m,
)
from roslings_rover.models.differential_drive import Body

AT_M, WITHIN_M = 0.4, 0.2


def circle(turns: float, radius_m: float, count: int) -> list[RoomTick]:
    """Ticks on a circle around (0, 0)."""
    angles = [turns * math.tau * number / count for number in range(count + 1)]
    return [tick(radius_m * math.cos(each), radius_m * math.sin(each)) for each in angles]


def test_the_hull_is_that_of_the_rover() -> None:
    """The judge does not load the rover, and must know as much."""
    assert Body().radius_m == HULL_M


# --- way and ground ----------------------------------------------------------------------------


def test_a_way_is_as_long_as_its_steps() -> None:
    """None, and one."""
    assert way_m(drive()) == way_m(drive([tick()])) == 0.0
    assert way_m(drive(straight(101))) == pytest.approx(1.0)


def test_straight_on_all_ground_is_new() -> None:
    """Also across cells."""
    assert covered_m(drive(straight(301))) == pytest.approx(3.0)


def test_ground_is_new_once() -> None:
    """There and back again is one way; so is one that stands for a minute."""
    there = straight(201)
    assert covered_m(drive([*there, *reversed(there)])) == pytest.approx(2.0, abs=0.03)
    assert covered_m(drive([*there, *[there[-1]] * 1200])) == pytest.approx(2.0)


def test_circles_cover_little() -> None:
    """Ten of them no more than one; and on the spot nothing that counts."""
    once, often = circle(1, 0.5, 200), circle(10, 0.5, 2000)
    assert way_m(drive(often)) == pytest.approx(10 * math.pi, rel=0.01)
    assert covered_m(drive(often)) <= covered_m(drive(once)) * 1.1
    assert covered_m(drive(circle(40, 0.02, 4000))) <= 4 * CELL_M * math.sqrt(2)


def test_a_cell_counts_no_more_than_its_diagonal() -> None:
    """Who wriggles inside of it drives far, and gets nowhere."""
    wriggles = [tick(0.05 + 0.1 * (number % 2), 0.1) for number in range(400)]
    assert way_m(drive(wriggles)) > 30
    assert covered_m(drive(wriggles)) == pytest.approx(CELL_M * math.sqrt(2))


# --- a wall ------------------------------------------------------------------------------------


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_distance_counts_from_the_wall_on(side: Side) -> None:
    """The way to it does not; all that comes after does, also where the wall is lost again."""
    distances_m = [3.0, 2.0, 1.0, 0.55, 0.45, 0.4, 0.35, 0.9]
    found = wall_distance(drive(beside(*distances_m, side=side)), side, AT_M, WITHIN_M)
    assert found
    assert (found.from_s, found.count) == (4 * PERIOD_S, 5)
    assert found.mean_m == pytest.approx((0.55 + 0.45 + 0.4 + 0.35 + 0.9) / 5)
    assert found.mean_off_m == pytest.approx((0.15 + 0.05 + 0.0 + 0.05 + 0.5) / 5)
    assert found.p95_off_m == pytest.approx(0.5)
    assert found.p95_m == 0.9


def test_the_other_side_is_no_wall() -> None:
    """The right wall of who should follow the left one."""
    follows_right = drive(beside(*[AT_M] * 40, side="right"))
    assert wall_distance(follows_right, "left", AT_M, WITHIN_M) is None
    assert wall_distance(drive(), "left", AT_M, WITHIN_M) is None


def test_five_of_a_hundred_are_left_out() -> None:
    """A corner, for a moment: the sixth is no moment any more."""
    five = [*[AT_M] * 95, *[FREE_M] * 5]
    six = [*[AT_M] * 94, *[FREE_M] * 6]
    for distances_m, off_m in ((five, 0.0), (six, FREE_M - AT_M)):
        found = wall_distance(drive(beside(*distances_m)), "left", AT_M, WITHIN_M)
        assert found
        assert found.p95_off_m == pytest.approx(off_m)


@pytest.mark.parametrize(
    ("values", "part", "value"),
    [([7.0], 0.95, 7.0), ([2.0, 1.0], 0.5, 1.0), ([3.0, 1.0, 2.0], 1.0, 3.0), ([1.0, 2.0], 0, 1.0)],
)
def test_a_quantile_is_one_of_the_values(values: list[float], part: float, value: float) -> None:
    """The least that so many do not exceed."""
    assert quantile(values, part) == value
    assert min(values) <= mean(values) <= max(values)


# --- what moves --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "is_there"),
    [
        ({}, False),
        (thing(0.5), True),
        (thing(0.5, left_m=0.26), True),
        (thing(0.5, left_m=-0.28), False),
        (thing(-0.5), False),
        (thing(LOOKS_AHEAD_M + 0.21), True),
        (thing(LOOKS_AHEAD_M + 0.23), False),
        (thing(0.5, left_m=0.36, radius_m=0.2), True),
    ],
    ids=["nothing", "ahead", "hull", "beside", "behind", "near", "far", "large"],
)
def test_what_is_in_the_way(words: dict[str, float], is_there: bool) -> None:
    """Ahead, near, and so that the hull would touch it."""
    assert is_in_the_way(tick(**words)) is is_there


def test_an_encounter_that_ends_well() -> None:
    """It comes, the rover stands, it goes, the rover goes on."""
    comes = [*straight(20, **AWAY), *[tick(0.2, **NEAR)] * 20, *straight(40, **AWAY)]
    (met,) = encounters(drive(comes))
    assert met.from_s == pytest.approx(21 * PERIOD_S)
    assert met.to_s == pytest.approx(40 * PERIOD_S)
    assert met.stood_s
    assert met.stood_s - met.from_s == pytest.approx(STANDS_S)
    assert met.stood_m == met.nearest_m == pytest.approx(0.28)
    assert not met.bumped


def test_who_drives_on_never_stood() -> None:
    """And came near."""
    nearer = [tick(0.01 * n, **thing(0.6 - 0.01 * n)) for n in range(30)]
    (met,) = encounters(drive(nearer))
    assert met.stood_s is None
    assert met.stood_m is None
    assert met.nearest_m == pytest.approx(0.6 - 0.29 - 0.22)


def test_one_that_is_away_for_a_moment_is_the_same() -> None:
    """For longer than a second, it is another one."""
    for gap, count in ((15, 1), (30, 2)):
        ticks = [*straight(10, **NEAR), *straight(gap, **AWAY), *straight(10, **NEAR)]
        assert len(encounters(drive(ticks))) == count
    assert encounters(drive(straight(50, **AWAY))) == []


def test_a_bump_belongs_to_its_encounter() -> None:
    """One into a wall does not, nor one of another time."""
    ticks = [*straight(20, **AWAY), *straight(20, **NEAR)]
    cases = [((1.5, True), True), ((1.5, False), False), ((0.4, True), False)]
    for (time_s, moving), bumped in cases:
        (met,) = encounters(drive(ticks, bumps=[bump(time_s, moving)]))
        assert met.bumped is bumped


def test_whether_anything_was_said() -> None:
    """Zeros move nothing; a turn on the spot does."""
    still = {"forward_m_s": 0.0, "turn_rad_s": 0.0}
    silent = {"forward_m_s": None, "turn_rad_s": None}
    assert not said_anything(drive([tick(**still), tick(**silent)]))
    assert said_anything(drive([tick(**silent), tick(**{**still, "turn_rad_s": -0.5})]))
