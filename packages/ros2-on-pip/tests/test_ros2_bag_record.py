"""`ros2 bag record` beside real nodes: what is taken, how it is kept, and how it ends."""

from __future__ import annotations

import os
import pty
import signal
import sys
from pathlib import Path

import pytest
import yaml
from recorded import messages, offered, write_bag
from terminal import Running, Shell, eventually

from ros2_on_pip.commands.bag import ABSENT
from skips import needs

pytestmark = pytest.mark.slow

TALK = """
import sys, rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy, DurabilityPolicy
from std_msgs.msg import String

topic, reliability, durability = sys.argv[1:4]
rclpy.init()
node = Node("late")
voice = node.create_publisher(String, topic, QoSProfile(
    depth=10, reliability=ReliabilityPolicy[reliability], durability=DurabilityPolicy[durability]))
count = 0
def talk():
    global count
    voice.publish(String(data=f"late {count}"))
    count += 1
node.create_timer(0.02, talk)
rclpy.spin(node)
"""


def talking(topic: str, reliability: str = "RELIABLE", durability: str = "VOLATILE") -> list[str]:
    """The command of a node that talks on a topic."""
    return [sys.executable, "-c", TALK, topic, reliability, durability]


def record(*words: str) -> tuple[str, ...]:
    """The words of a recording into `b`."""
    return ("bag", "record", "-o", "b", *words)


def await_subscribed(running: Running, *topics: str) -> None:
    """Until each of these is recorded."""
    for topic in topics:
        running.wait_for(rf"\[rosbag2_recorder\]: Subscribed to topic '{topic}'")


def await_file(folder: Path, size: int = 500) -> None:
    """Until messages are on the disk."""
    eventually(lambda: any(f.stat().st_size > size for f in folder.glob("*.mcap")))


@pytest.fixture
def here(stage: Shell, tmp_path: Path) -> Shell:
    """The stage's terminal, in a folder of its own."""
    shell = Shell(stage.environment, tmp_path)
    shell.nodes = stage.nodes
    return shell


@pytest.mark.parametrize(
    ("words", "there", "not_there"),
    [
        (("-e", "^/(chatter|scan)$"), {"/chatter", "/scan"}, {"/cmd_vel", "/rosout"}),
        (("-a", "--exclude-regex", "c"), {"/rosout"}, {"/chatter", "/cmd_vel", "/scan"}),
        (("-a", "--exclude-topics", "/scan"), {"/chatter", "/rosout"}, {"/scan", "/heard"}),
        (("--all-topics", "--exclude-topic-types", "std_msgs/msg/String"), {"/scan"}, {"/chatter"}),
        (("--topic-types", "std_msgs/msg/String"), {"/chatter"}, {"/scan", "/secret/_whisper"}),
        (
            ("--topic-types", "std_msgs/msg/String", "--include-hidden-topics"),
            {"/chatter", "/_whisper"},
            set(),
        ),
        (
            ("--include-unpublished-topics", "-e", "heard|chatter", "--ignore-leaf-topics"),
            {"/heard"},
            {"/chatter"},
        ),
    ],
)
def test_topics_are_chosen(
    here: Shell, words: tuple[str, ...], there: set[str], not_there: set[str]
) -> None:
    """By name, type and expression; hidden ones and those without a publisher when asked for."""
    with here.start(*record(*words)) as running:
        await_subscribed(running, *there)
        assert running.interrupt() == 0
    kept = set(messages(here.folder / "b"))
    assert there <= kept
    assert not not_there & kept


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_the_end_makes_a_whole_bag(here: Shell, how: signal.Signals) -> None:
    """Ctrl-C, pressed twice by somebody in a hurry, and a kind `kill`."""
    with here.start(*record("/chatter")) as running:
        running.wait_for(r'WARN.*Positional "topics" argument deprecated')
        await_subscribed(running, "/chatter")
        await_file(here.folder / "b")
        running.process.send_signal(how)
        running.process.send_signal(signal.SIGINT)
        assert running.wait() == 0
        assert "Traceback" not in running.text
    assert messages(here.folder / "b")["/chatter"]
    assert "ROS Distro:        jazzy" in here("bag", "info", "b").lines


def test_a_killed_recording_is_reindexed(here: Shell) -> None:
    """What was said until a second before is there."""
    with here.start(*record("--topics", "/chatter")) as running:
        await_file(here.folder / "b")
        running.process.kill()
        running.wait()
    ran = here("bag", "info", "b")
    assert ran.code == 1
    assert "has no metadata.yaml: its recording was cut off" in ran.err
    assert "ros2 bag reindex b" in ran.err
    assert "b is whole again" in here("bag", "reindex", "b").out
    assert messages(here.folder / "b")["/chatter"]
    assert here("bag", "info", "b").code == 0


def test_quality_of_service_is_adapted_and_kept(here: Shell) -> None:
    """One that sends best effort is heard, and the bag says what it offered."""
    with here.start(*record("--topics", "/scan", "/chatter")) as running:
        await_subscribed(running, "/scan", "/chatter")
        await_file(here.folder / "b", 10_000)
        assert running.interrupt() == 0
    found = messages(here.folder / "b")
    assert found["/scan"] and found["/chatter"]
    assert [one.reliability.name for one in offered(here.folder / "b", "/scan")] == ["BEST_EFFORT"]
    assert [one.reliability.name for one in offered(here.folder / "b", "/chatter")] == ["RELIABLE"]


def test_publishers_that_differ_and_one_that_comes_late(empty: Shell) -> None:
    """The lesser quality reaches both; who offers still less later is named."""
    with (
        empty.program(talking("/mixed", "RELIABLE", "TRANSIENT_LOCAL")) as first,
        empty.program(talking("/mixed", "BEST_EFFORT", "TRANSIENT_LOCAL")) as second,
    ):
        eventually(lambda: "Publisher count: 2" in empty("topic", "info", "/mixed").out)
        with empty.start(*record("--topics", "/mixed", "/later")) as running:
            running.wait_for("Falling back to ReliabilityPolicy.BEST_EFFORT")
            running.wait_for("No node has the topic '/later' yet")
            with empty.program(talking("/later")) as third:
                await_subscribed(running, "/later")
                with empty.program(talking("/later", "BEST_EFFORT")):
                    running.wait_for("'/later', offering incompatible QoS")
                assert running.interrupt() == 0
                assert third.process.poll() is None
        assert first.process.poll() is None and second.process.poll() is None
    profiles = offered(empty.folder / "b", "/mixed")
    assert {one.reliability.name for one in profiles} == {"RELIABLE", "BEST_EFFORT"}
    assert {one.durability.name for one in profiles} == {"TRANSIENT_LOCAL"}


def test_a_profile_of_a_file_goes_first(here: Shell) -> None:
    """And one that is wrong is told before anything is made."""
    (here.folder / "qos.yaml").write_text("/scan: {reliability: reliable, depth: 1}\n")
    words = record("--topics", "/scan", "--qos-profile-overrides-path", "qos.yaml")
    with here.start(*words) as running:
        running.wait_for("Overriding subscription profile for /scan")
        running.wait_for("'/scan', offering incompatible QoS")
        assert running.interrupt() == 0
    assert messages(here.folder / "b")["/scan"] == []
    (here.folder / "qos.yaml").write_text("/scan: {reliability: perhaps}\n")
    ran = here("bag", "record", "-a", "-o", "c", "--qos-profile-overrides-path", "qos.yaml")
    assert (ran.code, (here.folder / "c").exists()) == (1, False)
    assert "the profiles of qos.yaml cannot be used" in ran.err


def test_a_long_recording_has_many_files(here: Shell) -> None:
    """A new one each second, compressed when it is full."""
    words = ("--topics", "/chatter", "-d", "1", "--compression-mode", "file")
    with here.start(*record(*words, "--compression-format", "zstd")) as running:
        eventually(lambda: (here.folder / "b/b_1.mcap.zstd").is_file())
        assert running.interrupt() == 0
    shown = here("bag", "info", "b").out
    assert "Files:             b_0.mcap.zstd\n                   b_1.mcap.zstd" in shown
    numbers = [int(m.data.rpartition(" ")[2]) for m in messages(here.folder / "b")["/chatter"]]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def test_files_of_a_size_with_a_name_and_words(here: Shell) -> None:
    """The recorder is a node like others; words of one's own are kept."""
    words = ("-a", "-b", "86016", "-s", "sqlite3", "--compression-mode", "message")
    more = ("--compression-format", "zstd", "--node-name", "box", "--custom-data", "robot=seven")
    with here.start(*record(*words, *more)) as running:
        running.wait_for(r"\[box\]: Subscribed to topic '/scan'")
        assert "/box" in here("node", "list").lines
        eventually(lambda: (here.folder / "b/b_1.db3").is_file())
        assert running.interrupt() == 0
    about = yaml.safe_load((here.folder / "b/metadata.yaml").read_text())
    assert about["rosbag2_bagfile_information"]["custom_data"] == {"robot": "seven"}
    assert about["rosbag2_bagfile_information"]["compression_mode"] == "MESSAGE"
    assert len(messages(here.folder / "b")["/scan"]) > 100


def test_time_is_taken_from_the_clock(empty: Shell) -> None:
    """Nothing is kept before /clock speaks; then the stamps are those of the simulation."""
    write_bag(empty.folder / "sim", [str(n) for n in range(10)])
    words = record("--topics", "/late", "--use-sim-time")
    with empty.program(talking("/late")), empty.start(*words) as running:
        await_subscribed(running, "/late")
        assert empty("bag", "play", "sim", "--clock", "100").code == 0
        assert running.interrupt() == 0
    begin = next(line for line in empty("bag", "info", "b").lines if line.startswith("Start"))
    assert "Sep  9 2001" in begin
    assert messages(empty.folder / "b")["/late"]


def test_the_space_bar_pauses(here: Shell) -> None:
    """A recorder that starts paused keeps nothing until then."""
    ours, theirs = pty.openpty()
    with here.start(*record("--topics", "/chatter", "--start-paused"), keys=theirs) as running:
        running.wait_for("Press SPACE for pausing/resuming")
        running.wait_for(r"Waiting for recording \(paused\)")
        await_subscribed(running, "/chatter")
        os.write(ours, b" ")
        running.wait_for("Resuming recording.")
        await_file(here.folder / "b")
        os.write(ours, b" ")
        running.wait_for("Pausing recording.")
        assert running.interrupt() == 0
    os.close(ours)
    os.close(theirs)
    assert messages(here.folder / "b")["/chatter"]


def test_a_place_that_cannot_be_written(empty: Shell) -> None:
    """No folder can be made there; a disk that gets full leaves a whole bag."""
    (empty.folder / "file").write_text("mine")
    ran = empty("bag", "record", "-a", "-o", "file/b")
    assert ran.code == 1
    assert "cannot write the bag 'file/b': Not a directory. Make room there" in ran.err


@needs("small disk of root's")
def test_a_full_disk_ends_the_recording(here: Shell) -> None:
    """It says so, and the bag holds what found room."""
    small = here.folder / "small"
    small.mkdir()
    words = ["bag", "record", "-a", "-o", "small/b"]
    copied = "cp -r small/b copy; exit $code"
    script = f'mount -t tmpfs -o size=300k none small || exit 77; "$@"; code=$?; {copied}'
    command = ["unshare", "-m", "sh", "-c", script, "sh", sys.executable]
    with here.program([*command, str(Path(__file__).with_name("ours.py")), *words]) as running:
        code = running.wait()
    assert code == 1, running.text
    assert "cannot write the bag 'small/b': No space left on device" in running.text
    assert len(messages(here.folder / "copy")["/scan"]) > 10


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--topics", "/a", "--exclude-topics", "/a"), "--exclude-topics argument requires"),
        (("/a", "--exclude-regex", "a"), "--exclude-regex argument requires either --all"),
        (("-a", "--compression-format", "zstd"), "without a compression mode"),
        (("-a", "--compression-mode", "file"), "needs --compression-format zstd"),
        (("-a", "-b", "10"), "Please provide a value greater than 1024"),
        (("-e", "*"), "'*' is no regular expression"),
        (("a b",), "'a b' is no valid name"),
    ],
)
def test_words_that_make_no_sense(empty: Shell, words: tuple[str, ...], said: str) -> None:
    """Nothing is made."""
    ran = empty("bag", "record", "-o", "b", *words)
    assert ran.code in (1, 2)
    assert said in ran.err
    assert not (empty.folder / "b").exists()


@pytest.mark.parametrize("verb", ABSENT)
def test_verbs_of_the_full_ros2_name_what_to_use(empty: Shell, verb: str) -> None:
    """And how to get the real one."""
    ran = empty("bag", verb, "x")
    assert ran.code == 2
    assert f"'ros2 bag {verb}' is part of the full ros2" in ran.err
    assert f"Here, use instead: {ABSENT[verb]}" in ran.err
