"""`rosbag2_py` as a student's program sees it: by its own name, from a plain environment."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from bags import read_by_mcap, read_by_rosbags, said, write

from ros2_on_pip.rosbag2.writing import BagWriterOptions
from sources import code_of

STAND_INS = code_of("ros2_on_pip") / "stand_ins"
sys.path.append(str(STAND_INS))

import rosbag2_py  # noqa: E402  the folder is on the path of every environment of ours

Environment = dict[str, str]
WRITER = '''
import sys

import rclpy
import rosbag2_py
from rclpy.node import Node
from rclpy.serialization import serialize_message
from std_msgs.msg import String


class SimpleBagRecorder(Node):
    """Writes what it hears on chatter."""

    def __init__(self, uri, storage):
        super().__init__("simple_bag_recorder")
        self.writer = rosbag2_py.SequentialWriter()
        storage_options = rosbag2_py._storage.StorageOptions(uri=uri, storage_id=storage)
        converter_options = rosbag2_py._storage.ConverterOptions("", "")
        self.writer.open(storage_options, converter_options)
        topic_info = rosbag2_py._storage.TopicMetadata(
            id=0, name="chatter", type="std_msgs/msg/String", serialization_format="cdr"
        )
        self.writer.create_topic(topic_info)
        self.subscription = self.create_subscription(String, "chatter", self.hear, 10)
        self.voice = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(0.02, self.talk)
        self.count = 0

    def talk(self):
        self.voice.publish(String(data="hello"))

    def hear(self, msg):
        self.writer.write("chatter", serialize_message(msg), self.get_clock().now().nanoseconds)
        self.count += 1
        if self.count == 5:
            raise KeyboardInterrupt


rclpy.init()
try:
    rclpy.spin(SimpleBagRecorder(sys.argv[1], sys.argv[2]))
except KeyboardInterrupt:
    pass
print("rosbag2_py from", rosbag2_py.__file__)
'''

READER = '''
import sys

import rclpy
import rosbag2_py
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from rosidl_runtime_py.utilities import get_message


class SimpleBagReader(Node):
    """Says again what a bag holds."""

    def __init__(self, uri):
        super().__init__("simple_bag_reader")
        self.reader = rosbag2_py.SequentialReader()
        storage_options = rosbag2_py.StorageOptions(uri=uri, storage_id="")
        converter_options = rosbag2_py.ConverterOptions("", "")
        self.reader.open(storage_options, converter_options)
        types = {t.name: t.type for t in self.reader.get_all_topics_and_types()}
        self.types = {name: get_message(kind) for name, kind in types.items()}
        self.voices = {n: self.create_publisher(k, n, 10) for n, k in self.types.items()}
        self.timer = self.create_timer(0.01, self.timer_callback)

    def timer_callback(self):
        if not self.reader.has_next():
            raise SystemExit
        topic, data, stamp = self.reader.read_next()
        self.voices[topic].publish(data)
        print(topic, deserialize_message(data, self.types[topic]).data, stamp > 10**18)


rclpy.init()
rclpy.spin(SimpleBagReader(sys.argv[1]))
'''


@pytest.fixture
def program(tmp_path: Path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs a program with the path of the environments that `./roslings` makes."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("ROS", "PYTHONPATH"))}
    environment = kept | {
        "PYTHONPATH": str(STAND_INS),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF",
        "HOME": str(tmp_path),
        "ROS_LOG_DIR": str(tmp_path / "log"),
    }

    def run(code: str, *words: str) -> subprocess.CompletedProcess[str]:
        (tmp_path / "program.py").write_text(code)
        return subprocess.run(
            [sys.executable, "program.py", *words],
            env=environment,
            cwd=tmp_path,
            text=True,
            capture_output=True,
            check=False,
            timeout=120,
        )

    return run


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_the_programs_of_the_tutorials_run(
    program: Callable[..., subprocess.CompletedProcess[str]], tmp_path: Path, storage: str
) -> None:
    """A node writes what it hears, and ends without a close(); another node reads it."""
    wrote = program(WRITER, "my_bag", storage)
    assert wrote.returncode == 0, wrote.stderr
    assert [text for _, _, text in read_by_rosbags(tmp_path / "my_bag")] == ["hello"] * 5
    read = program(READER, "my_bag")
    assert read.returncode == 0, read.stderr
    assert read.stdout.splitlines() == ["chatter hello True"] * 5


def opened(bag: Path) -> rosbag2_py.SequentialReader:
    """A reader of a bag."""
    reader = rosbag2_py.SequentialReader()
    reader.open(
        rosbag2_py.StorageOptions(uri=str(bag), storage_id="mcap"),
        rosbag2_py.ConverterOptions("cdr", "cdr"),
    )
    return reader


def rest(reader: rosbag2_py.SequentialReader) -> list[tuple[str, int]]:
    """Topic and stamp of each message that is left; the stamps are counted in steps."""
    found = []
    while reader.has_next():
        topic, _, time_ns = reader.read_next()
        found.append((topic, (time_ns - 10**18) // 10**8))
    return found


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    """Four moments, at each of which something is said on two topics."""
    pairs = zip(said("abcd"), said("wxyz", "/other"), strict=True)
    return write(tmp_path / "b", [message for pair in pairs for message in pair])


def test_a_filter_counts_from_here_on(bag: Path) -> None:
    """Nothing comes twice, and nothing of the same moment is lost."""
    reader = opened(bag)
    assert rest(reader)[:3] == [("/heard", 0), ("/other", 0), ("/heard", 1)]
    with pytest.raises(RuntimeError, match="at end"):
        reader.read_next()
    reader.seek(10**18)
    for _ in range(3):
        reader.read_next()
    reader.set_filter(rosbag2_py.StorageFilter(topics=["/other"]))
    assert rest(reader) == [("/other", 1), ("/other", 2), ("/other", 3)]
    reader.reset_filter()
    reader.seek(10**18 + 3 * 10**8)
    assert rest(reader) == [("/heard", 3), ("/other", 3)]
    reader.set_filter(rosbag2_py.StorageFilter(regex=".*h.*", exclude_topics=["/heard"]))
    reader.seek(0)
    assert rest(reader) == [("/other", n) for n in range(4)]
    with pytest.raises(RuntimeError, match="regular expression"):
        reader.set_filter(rosbag2_py.StorageFilter(regex_to_exclude="("))


def test_a_bag_is_read_backwards(bag: Path) -> None:
    """From the end, and from a moment on."""
    reader = opened(bag)
    by = rosbag2_py.ReadOrderSortBy
    assert not reader.set_read_order(rosbag2_py.ReadOrder(sort_by=by.PublishedTimestamp))
    assert reader.set_read_order(rosbag2_py.ReadOrder(by.ReceivedTimestamp, True))
    assert rest(reader)[:2] == [("/other", 3), ("/heard", 3)]
    reader.seek(10**18 + 10**8)
    assert rest(reader) == [("/other", 1), ("/heard", 1), ("/other", 0), ("/heard", 0)]


def test_what_a_bag_holds_is_told(bag: Path) -> None:
    """By the reader and by Info, and back into metadata.yaml."""
    found = rosbag2_py.Info().read_metadata(str(bag), "mcap")
    assert str(found) == str(opened(bag).get_metadata())
    assert "Topic: /heard | Type: std_msgs/msg/String | Count: 4 |" in str(found)
    assert (found.message_count, found.duration.nanoseconds) == (8, 3 * 10**8)
    assert found.starting_time.nanoseconds == 10**18
    assert found.files[0].duration.total_seconds() == 0.3
    first = found.topics_with_message_count[0].topic_metadata
    assert (first.id, first.name, first.serialization_format) == (1, "/heard", "cdr")
    text = (bag / "metadata.yaml").read_text()
    io = rosbag2_py.MetadataIo()
    io.write_metadata(str(bag), io.deserialize_metadata(text))
    assert (bag / "metadata.yaml").read_text() == text
    definition = opened(bag).get_all_message_definitions()[0]
    assert (definition.topic_type, definition.encoding) == ("std_msgs/msg/String", "ros2msg")
    assert "string data" in definition.encoded_message_definition


def test_a_writer_takes_what_jazzys_takes(tmp_path: Path) -> None:
    """Its arguments and its refusals; a bag is split, compressed, and complete at the end."""
    of = rosbag2_py
    options = of.CompressionOptions("zstd", of.CompressionMode.FILE)
    writer = of.SequentialCompressionWriter(options)
    writer.open(
        of.StorageOptions(str(tmp_path / "b"), custom_data={"a": "b"}), of.ConverterOptions()
    )
    qos = of._storage.QoS(3).best_effort().transient_local()
    writer.create_topic(of.TopicMetadata(0, "/heard", "std_msgs/msg/String", "cdr", [qos]))
    spare = of.TopicMetadata(1, "/spare", "std_msgs/msg/String", "cdr")
    writer.create_topic(spare)
    writer.remove_topic(spare)
    from bags import raw

    writer.write("/heard", raw("one"), 1)
    writer.split_bagfile()
    writer.write("/heard", raw("two"), 2)
    with pytest.raises(RuntimeError, match="Call create_topic"):
        writer.write("/spare", raw("x"), 3)
    with pytest.raises(TypeError, match="serialize_message"):
        writer.write("/heard", "text", 3)
    with pytest.raises(TypeError, match="whole number"):
        writer.write("/heard", raw("x"), 3.5)
    writer.close()
    with pytest.raises(RuntimeError, match="not open"):
        writer.write("/heard", raw("x"), 3)
    assert read_by_mcap(tmp_path / "b") == [("/heard", 1, "one"), ("/heard", 2, "two")]
    found = opened(tmp_path / "b").get_metadata()
    assert found.custom_data == {"a": "b"} and found.compression_mode == "FILE"
    kept = found.topics_with_message_count[0].topic_metadata.offered_qos_profiles[0]
    profile = of._storage.convert_rclcpp_qos_to_rclpy_qos(kept)
    assert (profile.reliability.name, profile.durability.name) == ("BEST_EFFORT", "TRANSIENT_LOCAL")


def test_what_jazzy_refuses_is_refused(tmp_path: Path) -> None:
    """So that a program that runs here runs there."""
    of = rosbag2_py
    with pytest.raises(TypeError, match="id"):
        of.TopicMetadata(name="/a", type="std_msgs/msg/String", serialization_format="cdr")
    with pytest.raises(TypeError, match="uri must be str"):
        of.StorageOptions(uri=tmp_path)
    with pytest.raises(RuntimeError, match="already exists"):
        of.SequentialWriter().open(of.StorageOptions(str(tmp_path)), of.ConverterOptions())
    with pytest.raises(RuntimeError, match="no storage 'bag'"):
        of.SequentialWriter().open(of.StorageOptions("b", "bag"), of.ConverterOptions())
    with pytest.raises(RuntimeError, match="only the serialization format cdr"):
        of.SequentialWriter().open(of.StorageOptions("b"), of.ConverterOptions("json", "cdr"))
    with pytest.raises(RuntimeError, match="snapshot_mode is part of the full ROS 2"):
        of.SequentialWriter().open(
            of.StorageOptions("b", snapshot_mode=True), of.ConverterOptions()
        )
    with pytest.raises(RuntimeError, match="nothing of that name"):
        opened(tmp_path / "nowhere")
    with pytest.raises(RuntimeError, match="not open"):
        of.SequentialReader().has_next()


def test_what_is_not_here_says_what_to_use() -> None:
    """Each name that Jazzy has besides."""
    for name in ("Player", "Recorder", "bag_rewrite"):
        with pytest.raises(ImportError, match="Here, use instead"):
            getattr(rosbag2_py, name)
    with pytest.raises(AttributeError):
        _ = rosbag2_py.nothing
    assert rosbag2_py.get_registered_readers() == rosbag2_py.get_registered_writers()
    assert rosbag2_py.get_default_storage_id() in rosbag2_py.get_registered_writers()


def test_a_bag_is_reindexed(tmp_path: Path) -> None:
    """As `ros2 bag reindex` does it."""
    bag = write(tmp_path / "b", said("abc"), BagWriterOptions("sqlite3"))
    (bag / "metadata.yaml").unlink()
    rosbag2_py.Reindexer().reindex(rosbag2_py.StorageOptions(str(bag)))
    assert len(read_by_rosbags(bag)) == 3


def test_the_real_one_goes_first(
    program: Callable[..., subprocess.CompletedProcess[str]], tmp_path: Path
) -> None:
    """A sourced ROS has its own on PYTHONPATH, which comes before this environment's packages."""
    real = tmp_path / "opt" / "rosbag2_py"
    real.mkdir(parents=True)
    (real / "__init__.py").write_text("")
    code = "import os, rosbag2_py; print(rosbag2_py.__file__)"
    kept = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    found = subprocess.run(
        [sys.executable, "-c", code],
        env=kept | {"PYTHONPATH": str(tmp_path / "opt")},
        text=True,
        capture_output=True,
        check=True,
    )
    assert found.stdout.strip() == str(real / "__init__.py")
