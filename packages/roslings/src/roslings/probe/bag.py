"""All that was said in one experiment as a bag: rosbag2's folder, with one MCAP file in it.

It is written by the package `rosbags`, after the watch, so that writing delays no message.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from ros2_on_pip.rosbag2.definition import definition_of
from roslings.evidence import Endpoint, ExperimentSeen, Qos, Spoken
from roslings.probe.content import from_plain
from roslings.probe.recorder import TopicRecorder
from roslings.probe.wall_clock import to_wall_ns

VERSION: Literal[9] = 9
"""The layout of Jazzy's rosbag2."""

MOST_BYTES = 64 * 1024 * 1024
LEFT_OUT = "left_out"


@dataclass(frozen=True)
class BagMessage:
    """One message of the bag: when it was sent (wall clock), where, and its bytes."""

    stamp_ns: int
    topic: str
    type: str
    raw: bytes
    qos: tuple[Qos, ...] = ()


def write_bag(folder: Path, seen: ExperimentSeen, recorders: Mapping[str, TopicRecorder]) -> None:
    """Write what the nodes and the grader said into the new folder `folder`.

    Messages count in the order of their source stamps. The bag ends at MOST_BYTES; how many did
    not find room stands in its metadata. No folder is made where nothing was said. Raises OSError.
    """
    lines = sorted(_lines(seen, recorders), key=lambda line: line.stamp_ns)
    kept = _within(lines, MOST_BYTES)
    missing = _count(seen, recorders) - len(kept)
    if kept:
        _write(folder, kept, missing)


def fresh_folder(folder: Path) -> Path:
    """`folder`, free for a new bag: the one of an earlier run there is called NAME-1, NAME-2."""
    if folder.is_dir():
        number = 1
        while (aside := folder.with_name(f"{folder.name}-{number}")).exists():
            number += 1
        folder.rename(aside)
    return folder


def _lines(seen: ExperimentSeen, recorders: Mapping[str, TopicRecorder]) -> Iterator[BagMessage]:
    later_ns = to_wall_ns()
    for recorder in recorders.values():
        topic = recorder.seen
        qos = tuple(e.qos for e in seen.graph.endpoints if _publishes(e, topic.name))
        for message, raw in recorder.raw_messages():
            stamp_ns = message.source_ns or message.arrival_ns + later_ns
            yield BagMessage(stamp_ns, topic.name, topic.type, raw, qos)
    for spoken in seen.spoken:
        yield _spoken_line(spoken, later_ns)


def _publishes(endpoint: Endpoint, topic: str) -> bool:
    return endpoint.kind == "publisher" and endpoint.topic == topic


def _spoken_line(spoken: Spoken, later_ns: int) -> BagMessage:
    from rclpy.serialization import serialize_message

    raw = serialize_message(from_plain(spoken.type, spoken.content))
    return BagMessage(spoken.sent_ns + later_ns, spoken.topic, spoken.type, raw, (spoken.offered,))


def _within(lines: Iterable[BagMessage], most_bytes: int) -> list[BagMessage]:
    """The first ones, as many as find room."""
    kept, size = [], 0
    for line in lines:
        size += len(line.raw)
        if size > most_bytes:
            break
        kept.append(line)
    return kept


def _count(seen: ExperimentSeen, recorders: Mapping[str, TopicRecorder]) -> int:
    """All messages, those without bytes too."""
    topics = [recorder.seen for recorder in recorders.values()]
    return sum(len(t.messages) + t.not_kept for t in topics) + len(seen.spoken)


def _write(folder: Path, lines: Iterable[BagMessage], missing: int) -> None:
    from rosbags.rosbag2 import StoragePlugin, Writer

    connections: dict[tuple[str, str], Any] = {}
    with Writer(folder, version=VERSION, storage_plugin=StoragePlugin.MCAP) as writer:
        for line in lines:
            key = line.topic, line.type
            if key not in connections:
                connections[key] = _connection(writer, line)
            writer.write(connections[key], line.stamp_ns, line.raw)
        if missing:
            writer.set_custom_data(LEFT_OUT, str(missing))


def _connection(writer: Any, line: BagMessage) -> Any:
    definition = definition_of(line.type)
    return writer.add_connection(
        line.topic,
        line.type,
        msgdef=definition.text,
        rihs01=definition.hash,
        offered_qos_profiles=[_kept(qos) for qos in line.qos],
    )


def _kept(qos: Qos) -> Any:
    """A quality of service as `rosbags` keeps it; 0 ns stands for no limit, as in rmw."""
    from rosbags import interfaces as bags

    unlimited = bags.QosTime(0, 0)
    deadline = bags.QosTime(*divmod(qos.deadline_ns, 10**9)) if qos.deadline_ns else unlimited
    return bags.Qos(
        history=bags.QosHistory.KEEP_LAST if qos.depth else bags.QosHistory.UNKNOWN,
        depth=qos.depth or 0,
        reliability=_member(bags.QosReliability, qos.reliability),
        durability=_member(bags.QosDurability, qos.durability),
        deadline=deadline,
        lifespan=unlimited,
        liveliness=_member(bags.QosLiveliness, qos.liveliness),
        liveliness_lease_duration=unlimited,
        avoid_ros_namespace_conventions=False,
    )


def _member(choices: Any, name: str) -> Any:
    """The choice of this name; `unknown` for a word that this version does not have."""
    return choices.__members__.get(name.upper(), choices.UNKNOWN)
