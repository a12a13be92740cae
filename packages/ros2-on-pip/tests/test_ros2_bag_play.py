"""`ros2 bag play` beside real nodes: what is said, when, under which name, and by which keys."""

from __future__ import annotations

import os
import pty
import re
import sys
from pathlib import Path
from typing import Any

import pytest
from recorded import messages, write_bag
from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import StoragePlugin
from terminal import Running, Shell, eventually

pytestmark = pytest.mark.slow

HEAR = """
import sys, rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy, DurabilityPolicy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String

rclpy.init()
node = Node("ears")
lasting = QoSProfile(depth=100, durability=DurabilityPolicy[sys.argv[1]])
def hear(topic):
    def say(message):
        print(topic, message.data, flush=True)
    return node.create_subscription(String, topic, say, lasting)
heard = [hear(topic) for topic in sys.argv[2:]]
clock = node.create_subscription(Clock, "/clock",
    lambda m: print("clock", m.clock.sec * 10**9 + m.clock.nanosec, flush=True), 100)
print("listening", flush=True)
rclpy.spin(node)
"""
BEGIN_NS = 10**18


def listener_of(*topics: str, durability: str = "VOLATILE") -> list[str]:
    """The command of a node that prints what it hears, and what time it is."""
    return [sys.executable, "-c", HEAR, durability, *topics]


def heard(running: Running, topic: str = "/heard") -> list[str]:
    """The texts that it has heard on a topic."""
    said = [line.partition(" ") for line in running.lines]
    return [text for name, _, text in said if name == topic]


def reliable(durability: QosDurability = QosDurability.VOLATILE, depth: int = 10) -> Qos:
    """What a publisher offers, as a bag keeps it."""
    never = QosTime(0, 0)
    return Qos(
        QosHistory.KEEP_LAST,
        depth,
        QosReliability.RELIABLE,
        durability,
        never,
        never,
        QosLiveliness.AUTOMATIC,
        never,
        False,
    )


@pytest.fixture
def texts(empty: Shell) -> list[str]:
    """A bag `b` of two topics: ten texts, a tenth of a second between two."""
    said = [str(number) for number in range(10)]
    write_bag(empty.folder / "b", said, topics=("/heard", "/other"))
    return said


@pytest.mark.parametrize(
    ("words", "on_heard", "on_other"),
    [
        (("--topics", "/heard"), 10, 0),
        (("--exclude-topics", "/heard"), 0, 10),
        (("-e", "/h.*"), 10, 0),
        (("-x", "/oth.."), 10, 0),
        (("-x", "other"), 10, 10),
        (("--start-offset", "0.45"), 5, 5),
        (("--playback-duration", "0.25"), 3, 3),
        (("--start-offset", "0.45", "--playback-duration", "0.2"), 2, 2),
    ],
)
def test_a_part_is_played(
    empty: Shell, texts: list[str], words: tuple[str, ...], on_heard: int, on_other: int
) -> None:
    """Some topics, and some time; who listens misses nothing of it."""
    with empty.program(listener_of("/heard", "/other")) as listener:
        listener.wait_for("listening")
        assert empty("bag", "play", "b", "-r", "5", *words).code == 0
        eventually(
            lambda: len(heard(listener)) + len(heard(listener, "/other")) >= on_heard + on_other
        )
        begin = 5 if "--start-offset" in words else 0
        assert heard(listener) == texts[begin : begin + on_heard]
        assert heard(listener, "/other") == texts[begin : begin + on_other]


def test_topics_get_other_names(empty: Shell, texts: list[str]) -> None:
    """And a rule that is none is told."""
    with empty.program(listener_of("/heard", "/new/name", "/there")) as listener:
        listener.wait_for("listening")
        ran = empty("bag", "play", "b", "-r", "10", "--remap", "/heard:=/new/name", "other:=there")
        assert ran.code == 0
        listener.wait_for("^/there 9$")
        assert heard(listener, "/new/name") == texts and heard(listener) == []
    ran = empty("bag", "play", "b", "-m", "/heard=/new")
    assert (ran.code, "'/heard=/new' is no rule for a name" in ran.err) == (2, True)


@pytest.mark.parametrize("rate", [0.5, 2.0])
def test_the_clock_runs_with_the_rate(empty: Shell, rate: float) -> None:
    """/clock tells the bag's time: between two ticks passes the rate's part of a second."""
    write_bag(empty.folder / "b", ["a", "b"], apart_ns=2 * 10**9)
    with empty.program(listener_of("/heard")) as listener:
        listener.wait_for("listening")
        assert empty("bag", "play", "b", "--rate", str(rate), "--clock", "20").code == 0
        listener.wait_for("/heard b")
    times = [int(text) for text in heard(listener, "clock")]
    assert times == sorted(times)
    assert BEGIN_NS <= times[0] < BEGIN_NS + 10**9
    wanted = 2 / rate * 20  # two seconds of the bag, 20 ticks in each real second
    assert len(times) == pytest.approx(wanted, rel=0.5)


def test_again_and_again(empty: Shell, texts: list[str]) -> None:
    """Until Ctrl-C."""
    with empty.program(listener_of("/heard")) as listener:
        listener.wait_for("listening")
        with empty.start("bag", "play", "b", "--loop", "-r", "10", "--delay", "0.01") as player:
            listener.wait_for("^/heard 9$", times=3)
            assert player.interrupt() == 2
            assert "Traceback" not in player.text
        assert heard(listener)[:30] == texts * 3


def test_keys_pause_and_step(empty: Shell, texts: list[str]) -> None:
    """It starts paused; the right arrow plays one message, the space bar all, and up is quicker."""
    ours, theirs = pty.openpty()
    with empty.program(listener_of("/heard", "/other")) as listener:
        listener.wait_for("listening")
        words = ("bag", "play", "b", "--start-paused", "--topics", "/heard")
        with empty.start(*words, keys=theirs) as player:
            player.wait_for("Press SPACE for Pause/Resume")
            for number in range(3):
                os.write(ours, b"\x1b[C")
                listener.wait_for(f"^/heard {number}$")
            assert heard(listener) == ["0", "1", "2"]
            os.write(ours, b"\x1b[A")
            player.wait_for("Set rate to 1.1")
            os.write(ours, b"\x1b[B")
            player.wait_for("Set rate to 0.99")
            os.write(ours, b" ")
            player.wait_for("Resuming play.")
            listener.wait_for("^/heard 9$")
            assert player.wait() == 0
    os.close(ours)
    os.close(theirs)
    assert heard(listener) == texts


def test_no_keys_are_read_where_nobody_wants_them(empty: Shell, texts: list[str]) -> None:
    """A script has a terminal too."""
    ours, theirs = pty.openpty()
    with empty.start(
        "bag", "play", "b", "-r", "10", "--disable-keyboard-controls", keys=theirs
    ) as player:
        assert player.wait() == 0
    os.close(ours)
    os.close(theirs)
    assert "Press SPACE" not in player.text


def test_who_comes_late_hears_what_lasts(empty: Shell) -> None:
    """The profile of the bag is offered again: transient local reaches a later listener."""
    profile = reliable(QosDurability.TRANSIENT_LOCAL, 100)
    write_bag(empty.folder / "b", ["a", "b", "c"], qos=[profile])
    ours, theirs = pty.openpty()
    with empty.start("bag", "play", "b", "--start-paused", keys=theirs) as player:
        player.wait_for("Press CURSOR_RIGHT for Play Next Message")
        lasting = listener_of(
            "/heard", durability="TRANSIENT_LOCAL"
        )  # it may meet the player afterwards
        with empty.program(lasting) as early:
            early.wait_for("listening")
            os.write(ours, b"\x1b[C")
            early.wait_for("^/heard a$")
        with empty.program(lasting) as late:
            late.wait_for("^/heard a$")
        player.interrupt()
    os.close(ours)
    os.close(theirs)


def test_publishers_that_differed_and_a_profile_of_a_file(empty: Shell) -> None:
    """It is said what is offered instead; a file decides otherwise."""
    other = reliable(QosDurability.TRANSIENT_LOCAL)
    write_bag(empty.folder / "b", ["a"] * 30, qos=[reliable(), other])
    (empty.folder / "qos.yaml").write_text("/heard: {reliability: best_effort, depth: 4}\n")
    with empty.start("bag", "play", "b", "--loop") as player:
        player.wait_for('Not all original publishers on topic "/heard" offered the same QoS')
        eventually(lambda: "Reliability: RELIABLE" in empty("topic", "info", "-v", "/heard").out)
        player.interrupt()
    words = ("--qos-profile-overrides-path", "qos.yaml", "--loop")
    with empty.start("bag", "play", "b", *words) as player:
        player.wait_for("Overriding publisher profile for /heard")
        eventually(lambda: "Reliability: BEST_EFFORT" in empty("topic", "info", "-v", "/heard").out)
        player.interrupt()


@pytest.mark.parametrize("mode", ["file", "message"])
def test_what_is_compressed_is_played(stage: Shell, tmp_path: Path, mode: str) -> None:
    """Recorded from a real talker, played to a real listener."""
    here = Shell(stage.environment, tmp_path)
    words = ("--compression-mode", mode, "--compression-format", "zstd")
    with here.start("bag", "record", "--topics", "/chatter", "-o", "b", *words) as recorder:
        recorder.wait_for("Subscribed to topic '/chatter'")
        here("topic", "echo", "--once", "/chatter")
        assert recorder.interrupt() == 0
    texts = [message.data for message in messages(here.folder / "b")["/chatter"]]
    assert texts
    assert here("bag", "play", "b", "-r", "10", "--remap", "/chatter:=/heard").code == 0
    stage.wait_heard(re.escape(texts[-1]))


def test_a_type_that_is_not_installed_is_left_out(empty: Shell) -> None:
    """The others are played."""
    write_bag(empty.folder / "b", ["a"], storage=StoragePlugin.SQLITE3)
    database = empty.folder / "b/b.db3"
    import sqlite3

    with sqlite3.connect(database) as connection:
        connection.execute("UPDATE topics SET type = 'my_own/msg/Thing'")
    file = empty.folder / "b/metadata.yaml"
    file.write_text(file.read_text().replace("std_msgs/msg/String", "my_own/msg/Thing"))
    ran = empty("bag", "play", "b")
    assert ran.code == 0
    assert "Topic '/heard' is left out. The message type 'my_own/msg/Thing' is not" in ran.err


def test_a_broken_bag_is_told(empty: Shell, texts: list[str]) -> None:
    """With the next step, before anything is played, and where it breaks in the middle."""
    file: Any = empty.folder / "b/b.mcap"
    file.write_bytes(file.read_bytes()[:300])
    for verb in ("play", "info"):
        ran = empty("bag", verb, "b/b.mcap")
        assert ran.code == 1
        assert "[ERROR] [ros2bag]: the bag 'b/b.mcap' is damaged" in ran.err
        assert "Traceback" not in ran.err


def test_info_shows_a_part_in_an_order(empty: Shell) -> None:
    """Names alone, and by the number of messages."""
    write_bag(empty.folder / "b", ["a"], topics=("/b", "/a", "/c"))
    assert empty("bag", "info", "-t", "b").lines == ["/b", "/a", "/c"]
    shown = re.findall("Topic: (/.)", empty("bag", "info", "b", "--sort", "name").out)
    assert shown == ["/a", "/b", "/c"]


def test_info_counts_what_services_were_asked(empty: Shell) -> None:
    """In a bag of a full ROS: requests and responses, each once."""
    from ros2_on_pip.rosbag2.metadata import Topic
    from ros2_on_pip.rosbag2.writing import BagWriter, BagWriterOptions

    writer = BagWriter(empty.folder / "b", BagWriterOptions())
    name = "/light/_service_event"
    writer.add_topic(Topic(name, "std_srvs/srv/SetBool_Event"))
    for number, kinds in ((7, (0, 1, 2, 3)), (8, (0,))):
        for kind in kinds:
            body = bytes([kind]) + bytes(11) + b"client of 16 ..." + bytes(4)
            raw = b"\0\1\0\0" + body + number.to_bytes(8, "little")
            writer.write(name, 10**18, raw)
    writer.close()
    plain, more = empty("bag", "info", "b").out, empty("bag", "info", "-v", "b").out
    service = "Service: /light | Type: std_srvs/srv/SetBool | "
    assert f"{service}Event Count: 5 | Serialization Format: cdr" in plain
    assert f"{service}Request Count: 2 | Response Count: 1 | Serialization" in more
    assert "Service:           1\n" in plain
