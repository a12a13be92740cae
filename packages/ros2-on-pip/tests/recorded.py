"""Bags for the tests of `ros2 bag`, made and read without our own code."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

TYPES = get_typestore(Stores.ROS2_JAZZY)
STRING = "std_msgs/msg/String"


def write_bag(
    bag: Path,
    texts: Iterable[str],
    storage: StoragePlugin = StoragePlugin.MCAP,
    topics: Iterable[str] = ("/heard",),
    qos: Iterable[Any] = (),
    apart_ns: int = 10**8,
) -> Path:
    """Each text on each topic, a tenth of a second between two, written by `rosbags`."""
    kind = TYPES.types[STRING]
    with Writer(bag, version=9, storage_plugin=storage) as writer:
        heard = [
            writer.add_connection(topic, STRING, typestore=TYPES, offered_qos_profiles=list(qos))
            for topic in topics
        ]
        for number, text in enumerate(texts):
            for connection in heard:
                raw = TYPES.serialize_cdr(kind(text), STRING)
                writer.write(connection, 10**18 + number * apart_ns, raw)
    return bag


def messages(bag: Path) -> dict[str, list[Any]]:
    """Topic to the messages on it, decoded by the definitions in the bag."""
    found: dict[str, list[Any]] = {}
    with AnyReader([bag]) as reader:
        for connection in reader.connections:
            found.setdefault(connection.topic, [])
        for connection, _, raw in reader.messages():
            found[connection.topic].append(reader.deserialize(raw, connection.msgtype))
    return found


def offered(bag: Path, topic: str) -> list[Any]:
    """The profiles that the bag keeps for a topic."""
    with AnyReader([bag]) as reader:
        connection = next(c for c in reader.connections if c.topic == topic)
        return list(connection.ext.offered_qos_profiles)  # type: ignore[union-attr]
