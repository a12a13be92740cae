"""Bags for tests, and the independent readers that open them."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable
from pathlib import Path

from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from ros2_on_pip.rosbag2.metadata import Topic
from ros2_on_pip.rosbag2.packing import ENDING, unpack_file
from ros2_on_pip.rosbag2.writing import BagWriter, BagWriterOptions

TYPES = get_typestore(Stores.ROS2_JAZZY)
STRING = "std_msgs/msg/String"
BEGIN_NS, STEP_NS = 10**18, 10**8
TOPICS = (Topic("/heard", STRING), Topic("/other", STRING))
Said = tuple[str, int, str]
"""Topic, stamp in nanoseconds, text."""


def raw(text: str) -> bytes:
    """A String as ROS serialises it."""
    return bytes(TYPES.serialize_cdr(TYPES.types[STRING](text), STRING))


def said(texts: Iterable[str], topic: str = "/heard") -> list[Said]:
    """A tenth of a second between two."""
    return [(topic, BEGIN_NS + n * STEP_NS, text) for n, text in enumerate(texts)]


def write(folder: Path, messages: Iterable[Said], plan: BagWriterOptions | None = None) -> Path:
    """A bag of ours with these messages."""
    writer = BagWriter(folder, plan or BagWriterOptions())
    for topic in TOPICS:
        writer.add_topic(topic)
    for topic_name, time_ns, text in messages:
        writer.write(topic_name, time_ns, raw(text))
    writer.close()
    return folder


def read_by_rosbags(folder: Path) -> list[Said]:
    """What the package `rosbags` finds in a bag, by the definitions that it carries."""
    with AnyReader([folder]) as reader:
        return [
            (c.topic, time_ns, reader.deserialize(data, c.msgtype).data)  # type: ignore[attr-defined]
            for c, time_ns, data in reader.messages()
        ]


def read_by_mcap(folder: Path) -> list[Said]:
    """What MCAP's own reader finds, file by file; it knows nothing of rosbag2's folders."""
    return [message for file in sorted(folder.glob("*.mcap*")) for message in _in_file(file)]


def _in_file(file: Path) -> list[Said]:
    if file.suffix == ENDING:
        with tempfile.TemporaryDirectory() as scratch:
            plain = Path(scratch) / file.stem
            unpack_file(file, plain)
            return _in_file(plain)
    with file.open("rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        return [
            (channel.topic, message.log_time, decoded.data)
            for _, channel, message, decoded in reader.iter_decoded_messages()
        ]
