"""Rooms from a seed: the same everywhere, never the same twice, and each can be driven through."""

from __future__ import annotations

import hashlib
import math
from collections import Counter
from itertools import combinations

import pytest
from room_planner import Grid, drive_along

from roslings_rover.models.rooms import (
    KINDS,
    PASSAGE_M,
    PAST_M,
    SEEDS,
    NoSeed,
    SeededRoom,
    moving_in,
    room_of,
    seed_of,
)
from roslings_rover.models.rooms.room import apart_m
from roslings_rover.models.world import Box, Circle, default_world
from roslings_rover.rover.in_room import RoomRover

CLOSED_M = 0.11
"""No rover fits between a wall and what is so near to it."""
FEW, MANY, DRIVEN = range(40), range(1_000), range(200)


# --- which room it is ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("seed", "digest"),
    [
        (0, "569244b22638552a"),
        (1, "aedc1eba13a771cd"),
        (17, "10beb3da2015e515"),
        (SEEDS - 1, "efdd38b1ba322ec8"),
    ],
)
def test_a_seed_is_the_same_room_on_every_computer(seed: int, digest: str) -> None:
    """Who has been given a seed has been given this room: a new way to make them is another one."""
    room = room_of.__wrapped__(seed)
    assert room == room_of(seed) and room.seed == seed
    assert hashlib.sha256(repr(room).encode()).hexdigest()[:16] == digest


def test_no_two_rooms_are_alike() -> None:
    """And there are all kinds, each often enough."""
    rooms = [room_of(seed) for seed in MANY]
    assert len({repr(room.world) for room in rooms}) == len(MANY)
    counts = Counter(room.kind for room in rooms)
    assert set(counts) == set(KINDS) and min(counts.values()) > len(MANY) / 5


@pytest.mark.parametrize(
    "typed", ["", "-1", "1.5", "abc", str(SEEDS), "9" * 5000, "\u0661\u0667", "1e3", " 7"]
)
def test_what_is_no_seed_is_refused_with_the_next_step(typed: str) -> None:
    """Whole numbers of 64 bits, in plain digits."""
    with pytest.raises(NoSeed, match="Give a whole number from 0 to 18446744073709551615"):
        seed_of(typed)


@pytest.mark.parametrize("given", [-1, SEEDS, 1.0, "17", True])
def test_a_program_is_refused_it_too(given: object) -> None:
    """By its own error, never by a room that nobody meant."""
    with pytest.raises(NoSeed):
        room_of(given)  # type: ignore[arg-type]


def test_the_first_and_the_last_seed_are_rooms() -> None:
    """As they are typed."""
    assert seed_of("0") == 0 and seed_of(str(SEEDS - 1)) == SEEDS - 1
    assert seed_of("017") == seed_of("0" * 5000 + "17") == 17


# --- what a room promises ------------------------------------------------------------------------


@pytest.mark.parametrize("seed", FEW)
def test_the_rover_starts_free_and_can_drive_ahead(seed: int) -> None:
    """From (0, 0) along x, also where what moves has come into the way."""
    room = room_of(seed)
    full = room.world_with(()).obstacles + tuple(track.swept for track in room.tracks)
    assert all(shape.gap(0.0, 0.0) > 0.4 for shape in full)
    assert -room.world.room.gap(0.0, 0.0) > 0.4
    assert room.at_first.distance(0.0, 0.0, 0.0) > 1.0


@pytest.mark.parametrize("seed", FEW)
def test_all_that_stands_or_moves_is_inside(seed: int) -> None:
    """And no obstacle is as thin as paper."""
    room = room_of(seed)
    inside = room.world.room
    for shape in (*room.world.obstacles, *(track.swept for track in room.tracks)):
        box = shape if isinstance(shape, Box) else _around(shape)
        assert box.west_m >= inside.west_m - 1e-6 and box.east_m <= inside.east_m + 1e-6
        assert box.south_m >= inside.south_m - 1e-6 and box.north_m <= inside.north_m + 1e-6
        assert min(box.east_m - box.west_m, box.north_m - box.south_m) > 0.09


def _around(circle: Circle) -> Box:
    x_m, y_m, r = circle.x_m, circle.y_m, circle.radius_m
    return Box(x_m - r, y_m - r, x_m + r, y_m + r)


def test_on_an_open_floor_things_stand_apart_or_touch() -> None:
    """No way is narrower than a passage; what moves counts as if it were everywhere at once."""
    rooms = [room for seed in MANY if (room := room_of(seed)).kind == "boxes"]
    for room in rooms:
        things = (*room.world.obstacles, *(track.swept for track in room.tracks))
        for one, two in combinations(things, 2):
            assert apart_m(one, two) > PASSAGE_M - 1e-6, (room.seed, one, two)
        for thing in things:
            for gap_m in _to_walls(room, thing):
                assert gap_m < CLOSED_M or gap_m > PASSAGE_M - 1e-6, (room.seed, thing)


def _to_walls(room: SeededRoom, thing: Circle | Box) -> list[float]:
    inside, box = room.world.room, thing if isinstance(thing, Box) else _around(thing)
    return [
        box.west_m - inside.west_m,
        inside.east_m - box.east_m,
        box.south_m - inside.south_m,
        inside.north_m - box.north_m,
    ]


def test_something_moves_in_every_room() -> None:
    """Out of nobody's way into the way, by at least a metre; and it hits nothing that stands."""
    for seed in MANY:
        room = room_of(seed)
        assert 1 <= len(room.tracks) <= 2
        for track in room.tracks:
            assert track.length_m > 1.0 and 0.1 <= track.speed_m_s <= 0.3
            for part in range(11):
                thing = track.at(track.length_m * part / 10)
                gap_m = room.world.room_at(thing.x_m, thing.y_m) - thing.radius_m
                assert gap_m > 0.04, (seed, track)


def test_what_moves_is_in_the_way_of_who_follows_a_wall() -> None:
    """Where it turns round, nobody passes between it and the wall, 0.4 m from that."""
    for seed in MANY:
        room = room_of(seed)
        for track in room.tracks:
            wall_m = room.world.room_at(*track.turn) - track.radius_m
            assert wall_m < CLOSED_M, (seed, track)


def test_there_is_a_way_past_what_moves() -> None:
    """Wherever it is: on one side of it a rover has floor enough."""
    for seed in MANY:
        room = room_of(seed)
        for track in room.tracks:
            for part in (0.0, 0.5, 1.0):
                thing = track.at(track.length_m * part)
                free_m = [_free_beside(room, thing, quarters) for quarters in range(4)]
                assert max(free_m) > PAST_M, (seed, track, free_m)


def _free_beside(room: SeededRoom, thing: Circle, quarters: int) -> float:
    """As far as a thin ray from its rim goes."""
    angle_rad = quarters * math.pi / 2
    return room.world.distance(thing.x_m, thing.y_m, angle_rad) - thing.radius_m


# --- solvable, by a planner ----------------------------------------------------------------------


def _solvable(seed: int) -> None:
    """All floor is reached, and so is all but what moves takes, were it everywhere at once."""
    room = room_of(seed)
    for in_the_way in ((), _swept(room)):
        grid = Grid(room, in_the_way)
        assert grid.free[grid.origin] and not grid.left_out, seed


def _swept(room: SeededRoom) -> list[Box]:
    return [track.swept for track in room.tracks]


@pytest.mark.parametrize("seed", FEW)
def test_a_planner_reaches_all_floor(seed: int) -> None:
    """Of some rooms; of a thousand when there is time."""
    _solvable(seed)


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, len(MANY), 100))
def test_a_planner_reaches_all_floor_of_a_thousand_rooms(first: int) -> None:
    """No seed is an unlucky one."""
    for seed in range(first, first + 100):
        _solvable(seed)


def test_a_planner_sees_a_way_that_is_closed() -> None:
    """The proof can fail: with a wall across the room, there is floor that it leaves out."""
    room = room_of(0)
    inside = room.world.room
    wall = Box(0.4, inside.south_m, 0.5, inside.north_m)
    assert Grid(room, (wall,)).left_out


def _driven(seed: int) -> None:
    room = room_of(seed)
    grid = Grid(room, _swept(room))
    rover = RoomRover(room)
    assert drive_along(rover, grid.route(grid.farthest)), seed
    assert rover.bumps == [], seed
    assert rover.way_m > 2.0, seed


@pytest.mark.parametrize("seed", FEW[:6])
def test_a_rover_drives_to_the_farthest_place_without_a_bump(seed: int) -> None:
    """By the planner's route, past what moves, which comes near and is not touched."""
    _driven(seed)


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, len(DRIVEN), 50))
def test_rovers_drive_to_the_farthest_place_of_many_rooms(first: int) -> None:
    """Nothing that moves holds a rover up for ever."""
    for seed in range(first, first + 50):
        _driven(seed)


def test_the_room_of_the_course_has_nothing_that_moves() -> None:
    """It is what it was."""
    assert moving_in(default_world()) == ()
