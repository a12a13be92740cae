"""Bags: written here and read by `rosbags`, written by `rosbags` and played here."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from rosbags.rosbag2 import Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from terminal import Shell

TYPES = get_typestore(Stores.ROS2_JAZZY)
INFO = r"""
Files:             b_0\.(mcap|db3)
Bag size:          [\d.]+ (B|KiB)
Storage id:        {storage}
ROS Distro:        jazzy
Duration:          \d+\.\d{{9}}s
Start:             \w{{3}} [ \d]\d \d{{4}} \d\d:\d\d:\d\d\.\d{{9}} \(\d+\.\d{{9}}\)
End:               \w{{3}} [ \d]\d \d{{4}} \d\d:\d\d:\d\d\.\d{{9}} \(\d+\.\d{{9}}\)
Messages:          (?P<count>\d+)
Topic information: Topic: /chatter \| Type: std_msgs/msg/String \| Count: \d+ \| Serialization Format: cdr
                   Topic: /cmd_vel \| Type: geometry_msgs/msg/TwistStamped \| Count: \d+ \| Serialization Format: cdr
Service:           0
Service information: $"""  # noqa: E501  the format has long lines


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_record_and_read(stage: Shell, tmp_path: Path, storage: str) -> None:
    """Ctrl-C completes the bag; every message in it can be read without ROS."""
    bag = tmp_path / "b"
    words = ("bag", "record", "--topics", "/chatter", "/cmd_vel", "-o", str(bag), "-s", storage)
    with stage.start(*words) as record:
        record.wait_for(r"\[rosbag2_recorder\]: Subscribed to topic '/cmd_vel'")
        record.wait_for("All requested topics are subscribed")
        stage("topic", "echo", "--once", "/chatter")  # time goes by, messages come
        assert record.interrupt() == 0
        record.wait_for("Recording stopped")
    texts, speeds = contents(bag)
    first = int(texts[0].removeprefix("Hello World: "))
    assert texts == [f"Hello World: {first + n}" for n in range(len(texts))]
    assert set(speeds) == {1.5}
    shown = stage("bag", "info", str(bag)).out.rstrip("\n")
    found = re.match(INFO.format(storage=storage), shown)
    assert found, shown
    assert int(found["count"]) == len(texts) + len(speeds)


def contents(bag: Path) -> tuple[list[str], list[float]]:
    """The texts on /chatter and the speeds on /cmd_vel in a bag, read by `rosbags`."""
    texts, speeds = [], []
    with Reader(bag) as reader:
        for connection, _, raw in reader.messages():
            message = TYPES.deserialize_cdr(raw, connection.msgtype)
            if connection.topic == "/chatter":
                texts.append(message.data)
            else:
                speeds.append(message.twist.linear.x)
    return texts, speeds


def write_bag(bag: Path, storage: StoragePlugin, texts: list[str]) -> None:
    """A bag on /heard, a tenth of a second between two messages, written by `rosbags`."""
    kind = TYPES.types["std_msgs/msg/String"]
    with Writer(bag, version=9, storage_plugin=storage) as writer:
        heard = writer.add_connection("/heard", kind.__msgtype__, typestore=TYPES)
        for number, text in enumerate(texts):
            raw = TYPES.serialize_cdr(kind(text), kind.__msgtype__)
            writer.write(heard, 10**18 + number * 10**8, raw)


@pytest.mark.parametrize("storage", list(StoragePlugin))
def test_play(stage: Shell, tmp_path: Path, storage: StoragePlugin) -> None:
    """Who listens hears every message, the first one too, in order."""
    texts = [f"{storage.name} {number}" for number in range(5)]
    write_bag(tmp_path / "b", storage, texts)
    ran = stage("bag", "play", str(tmp_path / "b"), "-r", "5")
    assert ran.code == 0
    assert "[rosbag2_player]: Set rate to 5" in ran.err
    stage.wait_heard(texts[-1])
    assert stage.nodes
    heard = [line for line in stage.nodes.lines if line.startswith(f"heard {storage.name}")]
    assert heard == [f"heard {text}" for text in texts]


def test_play_of_a_topic_that_is_not_in_the_bag(empty: Shell, tmp_path: Path) -> None:
    """A near miss."""
    write_bag(tmp_path / "b", StoragePlugin.MCAP, ["x"])
    ran = empty("bag", "play", "b", "--topics", "/herd")
    assert ran.code == 1
    assert "the bag has no topic '/herd'. Did you mean /heard?" in ran.err


@pytest.mark.parametrize(
    ("words", "said", "code"),
    [
        (("info", "nowhere"), "there is nothing of that name", 1),
        (("info", "."), "no bag can be read at '.'", 1),
        (("record",), "Must specify topics to record", 2),
        (("record", "-a", "-o", "."), "Output folder '.' already exists. Choose another", 1),
        (("convert", "-i", "x"), "is part of the full ros2", 2),
    ],
)
def test_what_cannot_be_done(empty: Shell, words: tuple[str, ...], said: str, code: int) -> None:
    """A reason and a next step."""
    ran = empty("bag", *words)
    assert ran.code == code
    assert said in ran.err


def test_record_of_a_misspelt_topic(stage: Shell, tmp_path: Path) -> None:
    """It waits for the topic, and names the near miss."""
    with stage.start("bag", "record", "/chater", "-o", str(tmp_path / "b")) as record:
        record.wait_for("No node has the topic '/chater' yet. Did you mean /chatter?")
        assert record.interrupt() == 0
    assert stage("bag", "info", str(tmp_path / "b")).lines[8] == "Messages:          0"
