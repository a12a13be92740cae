"""A class drives in secret rooms: the same for all, or for each student others."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from roslings.capabilities.rooms.chosen import LabHasNoRooms
from roslings.capabilities.rooms.seeds import SECRET
from roslings.course import lab
from roslings_class import grading
from roslings_class.command import GradeOptions, grade
from roslings_class.gradebook import Gradebook, gradebook
from roslings_class.result import GradingOrder
from roslings_class.room_secret import OtherRooms, RoomSecret, Whose, room_secret
from roslings_class.scheduler import GradingRequest
from roslings_class.submissions import Submission
from roslings_launcher.cli import main

WANDER = lab("wander")


@pytest.fixture
def book(tmp_path: Path) -> Iterator[Gradebook]:
    """A new one."""
    with gradebook(tmp_path, "wander") as made:
        yield made


def orders(rooms: RoomSecret | None, folder: Path) -> dict[str, GradingOrder]:
    """What is asked of the gradings of two hand-ins."""
    request = GradingRequest(lab="wander", scratch=folder, lock=folder / "lock", rooms=rooms)
    hand_ins = [Submission(name, folder / name) for name in ("anna", "ben")]
    return {each.name: request.order(each, "0", 1) for each in hand_ins}


@pytest.mark.parametrize("whose", [None, "same", "each"])
def test_a_gradebook_keeps_its_rooms(book: Gradebook, whose: Whose | None) -> None:
    """Who goes on tomorrow need not say it again."""
    made = room_secret(WANDER, book, whose, {})
    assert made is not None
    assert len(made.text) >= 32
    assert room_secret(WANDER, book, None, {}) == made
    assert room_secret(WANDER, book, whose, {SECRET: made.text}) == made


def test_no_two_gradebooks_have_the_same_rooms(book: Gradebook, tmp_path: Path) -> None:
    """Whoever was graded last year cannot know them."""
    folder = tmp_path / "other"
    folder.mkdir()
    with gradebook(folder, "wander") as other:
        assert room_secret(WANDER, book, None, {}) != room_secret(WANDER, other, None, {})


def test_an_instructors_own_text_is_taken(book: Gradebook) -> None:
    """Two who grade one class on two computers agree on it."""
    made = room_secret(WANDER, book, "same", {SECRET: "harbour"})
    assert made == RoomSecret(text="harbour")


@pytest.mark.parametrize(
    ("whose", "variables", "told"),
    [
        ("each", {}, "Type the same command with --rooms same"),
        (None, {SECRET: "quay"}, f"Type the same command without {SECRET}"),
    ],
)
def test_one_gradebook_has_not_two_kinds_of_rooms(
    book: Gradebook, whose: Whose | None, variables: dict[str, str], told: str
) -> None:
    """Its verdicts could not be compared."""
    room_secret(WANDER, book, "same", {SECRET: "harbour"})
    with pytest.raises(OtherRooms) as refused:
        room_secret(WANDER, book, whose, variables)
    assert told in str(refused.value)


def test_a_lab_without_rooms_has_no_secret(book: Gradebook) -> None:
    """Nothing is noted for it."""
    assert room_secret(lab("topics"), book, None, {SECRET: "harbour"}) is None


@pytest.mark.parametrize(("whose", "count"), [("same", 1), ("each", 2)])
def test_each_hand_in_is_told_its_rooms(whose: Whose, count: int, tmp_path: Path) -> None:
    """By its name, where each has others."""
    told = {
        each.room_secret
        for each in orders(RoomSecret(text="harbour", whose=whose), tmp_path).values()
    }
    assert len(told) == count
    assert {each.room_secret for each in orders(None, tmp_path).values()} == {""}


def test_a_grading_draws_from_what_it_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On another computer, too: it stands in the order, and not in the command's environment."""
    monkeypatch.setenv(SECRET, "of the command")
    order = orders(RoomSecret(text="harbour"), tmp_path)["anna"]
    seen: list[str] = []
    monkeypatch.setattr(grading, "answer", lambda _: seen.append(os.environ[SECRET]))
    monkeypatch.setattr(grading.signal, "signal", lambda *_: None)
    grading.main(order)
    assert seen == ["harbour"]


def test_rooms_of_a_lab_that_has_none_are_refused_before_anything_is_run(tmp_path: Path) -> None:
    """No gradebook is made."""
    choices = GradeOptions("topics", tmp_path, tmp_path / "grades", rooms="each")
    with pytest.raises(LabHasNoRooms):
        grade(choices)
    assert not (tmp_path / "grades").exists()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["topics", "--room", "7"], "The lab 'topics' drives in no rooms."),
        (["wander", "--room", "seven"], "'seven' names no room."),
        (["wander", *4 * ["--room", "7"]], "4 rooms. A check drives 3 at most."),
    ],
)
def test_rooms_that_a_check_cannot_drive_are_told_at_once(
    words: list[str],
    told: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Before anything is built."""
    monkeypatch.setenv("ROSLINGS_ROOMS", "")  # what the command sets ends with the test
    assert main(["check", *words, "--solution"]) == 2
    assert told in capsys.readouterr().err
