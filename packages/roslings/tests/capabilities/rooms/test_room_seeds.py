"""Which rooms are driven: the card's, the student's, and those that nobody can know before."""

from __future__ import annotations

import subprocess
import sys

import pytest
from pydantic import ValidationError

from roslings.capabilities.rooms.contract import (
    SEEDS,
    RoomsContract,
    RoomWords,
    StopBeforeContract,
    WallContract,
    rows,
)
from roslings.capabilities.rooms.record import Side
from roslings.capabilities.rooms.seeds import (
    OWN,
    SECRET,
    SIDES,
    BadRooms,
    RoomToDrive,
    own_rooms,
    secret_rooms,
)
from roslings_rover.models import rooms as of_the_rover

ROOMS = RoomsContract(own=(17, 3, 1), secret=5)
WALL = WallContract(side_parameter="side", at_m=0.4, mean_off_m=0.1, p95_off_m=0.25)


@pytest.fixture(autouse=True)
def nobody_chooses(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whoever runs the tests may have rooms of their own."""
    monkeypatch.delenv(OWN, raising=False)
    monkeypatch.delenv(SECRET, raising=False)


def seeds_of(rooms: list[RoomToDrive]) -> list[int]:
    """Their numbers."""
    return [each.seed for each in rooms]


def test_a_card_has_rooms_for_who_chooses_none() -> None:
    """In its order, and both sides in turn."""
    rooms = own_rooms(ROOMS)
    assert seeds_of(rooms) == [17, 3, 1]
    assert all(each.chosen for each in rooms)
    assert {each.side for each in rooms[:2]} == set(SIDES)
    assert rooms[0].side == rooms[2].side


def test_a_student_chooses(monkeypatch: pytest.MonkeyPatch) -> None:
    """As many as the card has, at the most."""
    monkeypatch.setenv(OWN, " 4  8 ")
    assert seeds_of(own_rooms(ROOMS)) == [4, 8]
    monkeypatch.setenv(OWN, "9 8 7 6 5")
    with pytest.raises(BadRooms, match=r"5 rooms\. A check drives 3 at most"):
        own_rooms(ROOMS)
    monkeypatch.setenv(OWN, " ")
    assert seeds_of(own_rooms(ROOMS)) == [17, 3, 1]


@pytest.mark.parametrize("words", ["seventeen", "17,3", "-1", "1.5", str(1 << 64)])
def test_what_is_no_room_is_told(monkeypatch: pytest.MonkeyPatch, words: str) -> None:
    """With the name of the variable: somebody typed it."""
    monkeypatch.setenv(OWN, f"17 {words}")
    with pytest.raises(BadRooms, match=f"^{OWN}: "):
        own_rooms(ROOMS)


def test_each_number_has_both_sides() -> None:
    """Which one comes first depends on the first room alone: it is the same each time."""
    first = {own_rooms(RoomsContract(own=(seed,)))[0].side for seed in range(20)}
    assert first == set(SIDES)
    assert own_rooms(ROOMS) == own_rooms(ROOMS)


def test_secret_rooms_are_other_ones_each_time() -> None:
    """By the seed of the experiment; the same seed gives the same."""
    one, two = secret_rooms(ROOMS, 1), secret_rooms(ROOMS, 2)
    assert len({*seeds_of(one), *seeds_of(two)}) == 10
    assert secret_rooms(ROOMS, 1) == one
    assert not any(each.chosen for each in one)
    assert {each.side for each in one} == set(SIDES)
    assert all(0 <= each.seed < SEEDS for each in one)


def test_an_instructors_secret_is_the_same_for_all(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever the seed; another secret has other rooms."""
    monkeypatch.setenv(SECRET, "quay")
    one = secret_rooms(ROOMS, 1)
    assert secret_rooms(ROOMS, 2) == one
    monkeypatch.setenv(SECRET, "pier")
    assert not {*seeds_of(one)} & {*seeds_of(secret_rooms(ROOMS, 1))}


def test_busy_rooms_come_first_and_have_their_side() -> None:
    """One of each side that is named, and none of them a second time."""
    busy: dict[Side, list[int]] = {"right": [7], "left": [8]}
    rooms = secret_rooms(ROOMS, 1, range(6, 11), busy)
    assert [(room.seed, room.side) for room in rooms[:2]] == [(7, "right"), (8, "left")]
    assert {*seeds_of(rooms)} == {*range(6, 11)}


def test_secret_rooms_are_the_same_in_each_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """Python's own hash of a text is not."""
    monkeypatch.setenv(SECRET, "quay")
    code = (
        "from roslings.capabilities.rooms.contract import RoomsContract;"
        "from roslings.capabilities.rooms.seeds import secret_rooms;"
        "print(*(each.seed for each in secret_rooms(RoomsContract(secret=5), 1)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert [int(word) for word in done.stdout.split()] == seeds_of(secret_rooms(ROOMS, 1))


def test_rooms_of_a_card_are_those_of_the_rover() -> None:
    """As many as 64 bits make."""
    assert SEEDS == of_the_rover.SEEDS
    RoomsContract(own=(SEEDS - 1,))
    with pytest.raises(ValidationError):
        RoomsContract(own=(SEEDS,))


@pytest.mark.parametrize("name", ["Side", "2nd", "a-side", ""])
def test_a_side_is_a_parameter(name: str) -> None:
    """By a name that ROS takes."""
    with pytest.raises(ValidationError):
        WallContract(side_parameter=name, at_m=0.4, mean_off_m=0.1, p95_off_m=0.25)


@pytest.mark.parametrize(
    ("rooms", "which"),
    [
        (RoomsContract(own=(1, 2)), "rooms: 2 that you choose; 60 s in each"),
        (RoomsContract(secret=5), "rooms: 5 that nobody has seen; 60 s in each"),
        (
            RoomsContract(own=(1,), secret=2, drives_s=30),
            "rooms: 1 that you choose, and 2 that nobody has seen; 30 s in each",
        ),
    ],
    ids=["own", "secret", "both"],
)
def test_a_task_tells_which(rooms: RoomsContract, which: str) -> None:
    """And no more, where the card asks for no more."""
    node = RoomWords(rooms=rooms)
    assert [*rows(node)] == [("drives in", which)]
    assert [*rows(RoomWords())] == []


def test_a_task_tells_what_is_asked() -> None:
    """A row for each."""
    rooms = RoomsContract(own=(1,), wall=WALL, stops=StopBeforeContract(from_m=0.1), covers_m=2)
    told = dict(rows(RoomWords(rooms=rooms)))
    assert [*told] == ["drives in", "follows a wall", "stops", "goes"]
    assert "`side` says" in told["follows a wall"]
    assert "off by 0.1 m in the mean, and by 0.25 m in 95 of 100" in told["follows a wall"]
    assert told["stops"] == "0.1 m before something that moves into its way"
    assert told["goes"] == "2 m of new ground in each room, at least"


def test_secret_rooms_are_drawn_among_those_that_are_fair() -> None:
    """Each once, and by the secret alone."""
    drawn = secret_rooms(ROOMS, "quay", range(100, 120))
    assert {*seeds_of(drawn)} <= {*range(100, 120)}
    assert len({*seeds_of(drawn)}) == ROOMS.secret
    assert drawn == secret_rooms(ROOMS, "quay", range(100, 120))
    assert drawn != secret_rooms(ROOMS, "harbour", range(100, 120))
    assert {room.side for room in drawn} == {"left", "right"}
