"""Rooms of the lab wander: which are driven, and that more than one design has all points."""

from __future__ import annotations

from functools import partial
from random import sample

import pytest
from designs import Rule, Waiting, bang_bang, vector_field
from driving import ROOMS, driven, failed, view_of
from fair_rooms import is_busy, unfair_to

from graders.wander.act import rooms_to_drive
from graders.wander.fair import BUSY, FAIR
from roslings.capabilities.rooms.record import RoomsSeen, Side
from roslings.capabilities.rooms.seeds import OWN, SECRET, SIDES, BadRooms
from roslings.capabilities.rooms.seen import encounters
from roslings.judge import ExperimentView

RULES: dict[str, Rule] = {"bang-bang": bang_bang, "vector field": vector_field}


@pytest.fixture(autouse=True)
def nobody_chooses(monkeypatch: pytest.MonkeyPatch) -> None:
    """The card's rooms."""
    monkeypatch.delenv(OWN, raising=False)
    monkeypatch.delenv(SECRET, raising=False)


def seen(rule: Rule, side: str = "") -> ExperimentView:
    """It drives in each room, along the wall that is asked for, or always along one side."""
    drives = [
        driven(room, Waiting(rule, side or room.side)) for room in rooms_to_drive(ROOMS, seed=1)
    ]
    return view_of(drives)


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


def test_more_rooms_than_a_check_drives_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """And not left aside in silence."""
    monkeypatch.setenv(OWN, "7 8 9 10")
    with pytest.raises(BadRooms, match=r"4 rooms\. A check drives 3 at most"):
        rooms_to_drive(ROOMS, seed=1)


def test_secret_rooms_are_fair_and_each_another_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a hundred secrets, no two have the same five, and each fair room is drawn some time."""
    drawn = []
    for secret in range(100):
        monkeypatch.setenv(SECRET, str(secret))
        drawn.append(frozenset(room.seed for room in rooms_to_drive(ROOMS, seed=1)))
    assert {len(each) for each in drawn} == {ROOMS.secret}
    assert len({*drawn}) == len(drawn)
    assert len(frozenset().union(*drawn) & {*FAIR}) > len(FAIR) * 0.8


def test_no_room_is_twice_among_them() -> None:
    """It would be drawn twice as often, or driven twice in one grading."""
    every = [*FAIR, *(seed for seeds in BUSY.values() for seed in seeds)]
    assert len({*every}) == len(every)


def test_along_each_wall_something_comes_into_the_way(monkeypatch: pytest.MonkeyPatch) -> None:
    """In secret rooms of an instructor, whatever the secret: stopping is judged in each grading."""
    for secret in range(100):
        monkeypatch.setenv(SECRET, str(secret))
        rooms = rooms_to_drive(ROOMS, seed=1)
        assert {room.side for room in rooms if room.seed in BUSY[room.side]} == {*SIDES}


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


@pytest.mark.slow
@pytest.mark.parametrize("number", range(3))
def test_a_fair_room_is_fair(number: int) -> None:
    """Three designs have all points in it, along either wall: other rooms at each run."""
    (seed,) = sample(FAIR, 1)
    assert [*unfair_to(seed)] == [], f"{number}: room {seed}"


@pytest.mark.slow
@pytest.mark.parametrize("side", SIDES)
def test_a_busy_room_is_busy(side: Side) -> None:
    """Something comes into the way of each design, and each has all points."""
    (seed,) = sample(BUSY[side], 1)
    assert is_busy(seed, side), f"room {seed}"
