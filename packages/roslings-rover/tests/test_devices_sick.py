"""`./roslings rover --sick`: a bag that any reader of bags can read, the same for the same name."""

from __future__ import annotations

import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest
import rosbag2_py
import yaml
from program import environment
from rclpy.serialization import deserialize_message
from rosidl_runtime_py.utilities import get_message

from roslings_rover.models.drives.sick_rover import sick_rover


def typed(home: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """What the command says."""
    return subprocess.run(
        [sys.executable, "-m", "roslings_rover", "rover", *words],
        capture_output=True,
        text=True,
        check=False,
        env=environment(0, home),
        cwd=home,
    )


def read(bag: Path) -> list[tuple[str, bytes, int]]:
    """All messages of a bag."""
    reader = rosbag2_py.SequentialReader()
    storage = rosbag2_py.StorageOptions(uri=str(bag), storage_id="")
    reader.open(storage, rosbag2_py.ConverterOptions("", ""))
    found = []
    while reader.has_next():
        found.append(reader.read_next())
    return found


def offered_in(bag: Path) -> dict[str, str]:
    """Topic to its reliability, as a student reads it in metadata.yaml."""
    held = yaml.safe_load((bag / "metadata.yaml").read_text("utf-8"))["rosbag2_bagfile_information"]
    topics = [each["topic_metadata"] for each in held["topics_with_message_count"]]
    return {each["name"]: each["offered_qos_profiles"][0]["reliability"] for each in topics}


def meant(bag: Path) -> list[tuple[str, str, int]]:
    """The same in words: between the fields of a message, bytes may stand that mean nothing."""
    info = rosbag2_py.Info().read_metadata(str(bag), "")
    types = {
        t.topic_metadata.name: get_message(t.topic_metadata.type)
        for t in info.topics_with_message_count
    }
    return [
        (topic, str(deserialize_message(data, types[topic])), time_ns)
        for topic, data, time_ns in read(bag)
    ]


def test_a_name_gives_a_bag_and_the_same_one_again(tmp_path: Path) -> None:
    """Message by message, in the home folder where nobody names a place."""
    first = typed(tmp_path, "--sick", "--name", "Ada Lovelace")
    assert first.returncode == 0, first.stderr
    assert "Look at it: ros2 bag info " in first.stdout
    again = typed(tmp_path, "--sick", "--name", "lovelace, ada", "--to", "again")
    assert again.returncode == 0, again.stderr
    assert meant(tmp_path / "sick_rover") == meant(tmp_path / "again")


def test_the_bag_says_what_the_model_says(tmp_path: Path) -> None:
    """Each topic with its type, its messages, its stamps and what was offered."""
    assert typed(tmp_path, "--sick", "--name", "Grace Hopper", "--to", "bag").returncode == 0
    rover = sick_rover("Grace Hopper")
    info = rosbag2_py.Info().read_metadata(str(tmp_path / "bag"), "")
    counts = Counter(said.topic for said in rover.said)
    told = {t.topic_metadata.name: t for t in info.topics_with_message_count}
    assert {name: topic.message_count for name, topic in told.items()} == counts
    offers = offered_in(tmp_path / "bag")
    for topic in rover.plan.topics:
        assert told[topic.name].topic_metadata.type == topic.sheet.type
        offered = "reliable" if topic.reliable else "best_effort"
        assert offers[topic.name] == offered
    for said, (name, data, time_ns) in zip(rover.said, read(tmp_path / "bag"), strict=True):
        assert (said.topic, said.time_ns) == (name, time_ns)
        message = deserialize_message(data, get_message(told[name].topic_metadata.type))
        if hasattr(message, "header"):
            stamp = message.header.stamp
            assert stamp.sec * 10**9 + stamp.nanosec == said.stamp_ns
            assert message.header.frame_id == said.frame


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("--sick",), "--name"),
        (("--sick", "--name", "?"), "--name"),
        (("--name", "Ada"), "belong to --sick"),
    ],
)
def test_what_is_missing_is_told(words: tuple[str, ...], says: str, tmp_path: Path) -> None:
    """And nothing is written."""
    ran = typed(tmp_path, *words)
    assert ran.returncode == 2 and says in ran.stderr
    assert not any(tmp_path.iterdir())


def test_a_folder_that_is_there_stays_as_it_is(tmp_path: Path) -> None:
    """A bag that somebody needs is not written over."""
    (tmp_path / "bag").mkdir()
    ran = typed(tmp_path, "--sick", "--name", "Ada", "--to", "bag")
    assert ran.returncode == 2 and "--to FOLDER" in ran.stderr
    assert not any((tmp_path / "bag").iterdir())
