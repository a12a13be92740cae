"""The bag of a drive: it takes the place of the rover's own last one, and of nothing else."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from roslings_my_rover.drive_bag import LIST, NotOurBag, bag_place, kept, require_place


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty one, which is not there yet."""
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path / "ws"))
    return tmp_path / "ws"


def recorded(folder: Path, word: str, whole: bool = True) -> Path:
    """What a recorder leaves behind."""
    bag = folder / "recorded"
    shutil.rmtree(bag, ignore_errors=True)
    bag.mkdir(parents=True)
    (bag / "recorded_0.mcap").write_text(word)
    if whole:
        (bag / "metadata.yaml").write_text("rosbag2_bagfile_information:\n")
    return bag


def word_in(bag: Path) -> str:
    """Which drive it holds."""
    return (bag / "recorded_0.mcap").read_text()


def names_in(folder: Path) -> set[str]:
    """What lies there."""
    return {each.name for each in folder.iterdir()}


def all_files(folder: Path) -> dict[str, str]:
    """Path to content, of all that lies there."""
    return {
        str(each.relative_to(folder)): each.read_text() if each.is_file() else "folder"
        for each in sorted(folder.rglob("*"))
    }


def test_the_next_drive_takes_the_place_of_the_last_one(workspace: Path, tmp_path: Path) -> None:
    """Whole, and nothing is left beside it."""
    for word in ("first", "second"):
        require_place()
        assert "black_box read_drive" in kept(recorded(tmp_path, word))
        assert word_in(bag_place()) == word
    assert names_in(workspace) == {"my_rover_bag"}
    assert names_in(bag_place()) == {"metadata.yaml", "recorded_0.mcap", LIST}


def test_one_that_is_not_whole_leaves_the_last_one(workspace: Path, tmp_path: Path) -> None:
    """A recorder that was killed has written no metadata."""
    kept(recorded(tmp_path, "first"))
    told = kept(recorded(tmp_path, "cut short", whole=False))
    assert "No bag was kept" in told and "still there" in told
    assert word_in(bag_place()) == "first"


def test_a_disk_that_refuses_leaves_the_last_one(
    workspace: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With the reason, and the next step; half a copy is gone."""
    kept(recorded(tmp_path, "first"))
    bag = recorded(tmp_path, "second")
    (bag / "recorded_1.mcap").symlink_to("/dev/full/not/there")
    told = kept(bag)
    assert "No bag was kept: " in told and "Free some space" in told
    assert word_in(bag_place()) == "first" and names_in(workspace) == {"my_rover_bag"}


def a_file(place: Path) -> None:
    """Of that name."""
    place.write_text("mine")


def a_folder(place: Path) -> None:
    """With notes in it."""
    place.mkdir()
    (place / "notes.txt").write_text("mine")


def an_empty_folder(place: Path) -> None:
    """Somebody will need it."""
    place.mkdir()


def a_bag_of_ones_own(place: Path) -> None:
    """By `ros2 bag record -o my_rover_bag`."""
    shutil.copytree(recorded(place.parent, "mine"), place)
    shutil.rmtree(place.parent / "recorded")


def a_bag_with_notes(place: Path) -> None:
    """The rover's, in which somebody has put more."""
    kept(recorded(place.parent, "first"))
    shutil.rmtree(place.parent / "recorded")
    (place / "notes.txt").write_text("mine")


def a_link(place: Path) -> None:
    """To a bag of the rover's that somebody keeps elsewhere."""
    kept(recorded(place.parent, "first"))
    shutil.rmtree(place.parent / "recorded")
    place.rename(place.with_name("elsewhere"))
    place.symlink_to("elsewhere")


def a_dangling_link(place: Path) -> None:
    """To nothing."""
    place.symlink_to("nowhere")


NOT_OURS = [
    a_file,
    a_folder,
    an_empty_folder,
    a_bag_of_ones_own,
    a_bag_with_notes,
    a_link,
    a_dangling_link,
]


@pytest.mark.parametrize("put", NOT_OURS, ids=lambda put: put.__name__)
def test_what_is_not_the_rovers_stays(workspace: Path, put: Callable[[Path], None]) -> None:
    """Before the drive it is told, with a command that helps."""
    workspace.mkdir()
    put(bag_place())
    before = all_files(workspace)
    with pytest.raises(NotOurBag) as told:
        require_place()
    assert all_files(workspace) == before
    (typed,) = re.findall(r"(mv .*)$", str(told.value))
    assert os.system(typed) == 0
    require_place()


@pytest.mark.parametrize("put", NOT_OURS, ids=lambda put: put.__name__)
def test_what_came_during_the_drive_stays_too(
    workspace: Path, tmp_path: Path, put: Callable[[Path], None]
) -> None:
    """The drive's bag is kept under another name, and that one is told."""
    workspace.mkdir()
    put(bag_place())
    before = all_files(workspace)
    told = kept(recorded(tmp_path, "second"))
    assert "my_rover_bag_2" in told
    assert word_in(workspace / "my_rover_bag_2") == "second"
    assert {k: v for k, v in all_files(workspace).items() if "bag_2" not in k} == before


def test_a_list_of_any_size_and_kind_is_read_within_a_bound(workspace: Path) -> None:
    """It may be another's, too: then the folder is not the rover's."""
    bag_place().mkdir(parents=True)
    (bag_place() / LIST).write_bytes(b"\xff\n" * 200_000 + b"mine\n")
    (bag_place() / "mine").write_text("mine")
    with pytest.raises(NotOurBag):
        require_place()
