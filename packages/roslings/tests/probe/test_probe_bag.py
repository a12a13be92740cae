"""A bag's types, its bound, and what it does with an earlier one."""

from __future__ import annotations

from pathlib import Path

import pytest
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from ros2_on_pip.rosbag2.definition import NO_HASH, definition_of
from roslings.evidence import ExperimentSeen, Qos, Spoken
from roslings.probe import bag

TYPES = get_typestore(Stores.ROS2_JAZZY)
STRING = "std_msgs/msg/String"


@pytest.mark.parametrize("name", [STRING, "sensor_msgs/msg/Imu", "geometry_msgs/msg/TwistStamped"])
def test_a_definition_can_be_read_without_ros(name: str) -> None:
    """By itself: every type in it is there, and the hash is the one that a reader computes."""
    found = definition_of(name)
    types = get_types_from_msg(found.text, name)
    store = get_typestore(Stores.EMPTY)
    store.register(types)
    assert store.hash_rihs01(name) == TYPES.hash_rihs01(name) == found.hash


@pytest.mark.parametrize("name", ["my_own/msg/Thing", "nonsense", "a/b/c/d", "../msg/x"])
def test_a_type_that_is_not_installed_has_none(name: str) -> None:
    """Its bytes are kept all the same."""
    assert definition_of(name) == definition_of("")
    assert definition_of(name).hash == NO_HASH


def said(*texts: str) -> ExperimentSeen:
    """An experiment in which the grader said these."""
    seen = ExperimentSeen(name="hearing", clock="wall")
    seen.spoken = [
        Spoken(
            topic="/it", type=STRING, content={"data": text}, sent_ns=n, matched=True, offered=Qos()
        )
        for n, text in enumerate(texts)
    ]
    return seen


def texts_in(folder: Path) -> list[str]:
    """What a bag holds."""
    with Reader(folder) as reader:
        return [TYPES.deserialize_cdr(raw, c.msgtype).data for c, _, raw in reader.messages()]


def test_a_bag_is_bounded_and_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The first messages are kept, the others counted."""
    monkeypatch.setattr(bag, "MOST_BYTES", 40)
    bag.write_bag(tmp_path / "b", said("one", "two", "x" * 100, "four"), {})
    assert texts_in(tmp_path / "b") == ["one", "two"]
    assert f"{bag.LEFT_OUT}: '2'" in (tmp_path / "b/metadata.yaml").read_text()


def test_where_nothing_was_said_there_is_no_bag(tmp_path: Path) -> None:
    """An empty one has no time, and no reader likes it."""
    bag.write_bag(tmp_path / "b", said(), {})
    assert list(tmp_path.iterdir()) == []


def test_an_earlier_run_keeps_its_bag(tmp_path: Path) -> None:
    """The last run has the plain name."""
    for text in ("first", "second", "third"):
        bag.write_bag(bag.fresh_folder(tmp_path / "b"), said(text), {})
    assert {p.name: texts_in(p) for p in tmp_path.iterdir()} == {
        "b": ["third"],
        "b-1": ["first"],
        "b-2": ["second"],
    }
