"""What a bag is opened with, and what stands in it."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from datetime import timedelta
from enum import Enum
from pathlib import Path
from typing import Any, get_type_hints

from ros2_on_pip.rosbag2 import metadata as bag
from ros2_on_pip.rosbag2.quality import kept, offered
from ros2_on_pip.rosbag2.reading import read_metadata
from ros2_on_pip.rosbag2.reindexing import write_metadata
from ros2_on_pip.rosbag2.summary import lines_of

from ._errors import as_runtime_error
from ._qos import (
    Duration,
    QoS,
    convert_rclcpp_qos_to_rclpy_qos,
    rmw_qos_durability_policy_t,
    rmw_qos_history_policy_t,
    rmw_qos_liveliness_policy_t,
    rmw_qos_reliability_policy_t,
)

__all__ = [
    "BagMetadata",
    "ConverterOptions",
    "Duration",
    "FileInformation",
    "MessageDefinition",
    "MetadataIo",
    "QoS",
    "ReadOrder",
    "ReadOrderSortBy",
    "StorageFilter",
    "StorageOptions",
    "TopicInformation",
    "TopicMetadata",
    "convert_rclcpp_qos_to_rclpy_qos",
    "get_default_storage_id",
    "rmw_qos_durability_policy_t",
    "rmw_qos_history_policy_t",
    "rmw_qos_liveliness_policy_t",
    "rmw_qos_reliability_policy_t",
    "to_rclcpp_qos_vector",
]

PLAIN = (str, int, bool)


class Checked:
    """A dataclass that takes for text nothing but text, as the compiled classes of Jazzy do."""

    def __post_init__(self) -> None:
        hints = get_type_hints(type(self))
        for each in fields(self):  # type: ignore[arg-type]
            wanted, value = hints[each.name], getattr(self, each.name)
            if wanted in PLAIN and not isinstance(value, wanted):
                raise TypeError(
                    f"{type(self).__name__}: {each.name} must be {wanted.__name__},"
                    f" and is {type(value).__name__}"
                )


@dataclass
class StorageOptions(Checked):
    """Where a bag lies, and how it is stored."""

    uri: str
    storage_id: str = ""
    max_bagfile_size: int = 0
    max_bagfile_duration: int = 0
    max_cache_size: int = 0
    storage_preset_profile: str = ""
    storage_config_uri: str = ""
    snapshot_mode: bool = False
    start_time_ns: int = -1
    end_time_ns: int = -1
    custom_data: dict[str, str] = field(default_factory=dict)


@dataclass
class ConverterOptions(Checked):
    """How messages are turned into bytes; here always `cdr`."""

    input_serialization_format: str = ""
    output_serialization_format: str = ""


@dataclass
class StorageFilter(Checked):
    """Which messages are read."""

    topics: list[str] = field(default_factory=list)
    services_events: list[str] = field(default_factory=list)
    regex: str = ""
    exclude_topics: list[str] = field(default_factory=list)
    exclude_service_events: list[str] = field(default_factory=list)
    regex_to_exclude: str = ""


class ReadOrderSortBy(Enum):
    """By what messages are sorted."""

    ReceivedTimestamp = 0
    PublishedTimestamp = 1
    File = 2


@dataclass
class ReadOrder:
    """In which order messages are read."""

    sort_by: ReadOrderSortBy = ReadOrderSortBy.ReceivedTimestamp
    reverse: bool = False


@dataclass
class TopicMetadata(Checked):
    """A topic of a bag."""

    id: int
    name: str
    type: str
    serialization_format: str
    offered_qos_profiles: list[QoS] = field(default_factory=list)
    type_description_hash: str = ""

    def equals(self, other: TopicMetadata) -> bool:
        """Whether name, type and format are the same."""
        return _key(self) == _key(other)


def _key(topic: TopicMetadata) -> tuple[str, str, str]:
    return topic.name, topic.type, topic.serialization_format


@dataclass
class TopicInformation:
    """A topic, and how many messages it has."""

    topic_metadata: TopicMetadata
    message_count: int


@dataclass
class MessageDefinition(Checked):
    """The text that defines a type."""

    topic_type: str
    encoding: str
    encoded_message_definition: str
    type_hash: str


@dataclass
class FileInformation:
    """A file of a bag."""

    path: str
    starting_time: Any
    """An rclpy Time."""
    duration: timedelta
    message_count: int


def _never() -> Any:
    from rclpy.time import Time

    return Time()


def _no_time() -> Any:
    from rclpy.duration import Duration

    return Duration()


@dataclass(repr=False)
class BagMetadata:
    """What a bag holds; `duration` is an rclpy Duration, `starting_time` an rclpy Time."""

    version: int = bag.VERSION
    bag_size: int = 0
    storage_identifier: str = ""
    relative_file_paths: list[str] = field(default_factory=list)
    files: list[FileInformation] = field(default_factory=list)
    duration: Any = field(default_factory=_no_time)
    starting_time: Any = field(default_factory=_never)
    message_count: int = 0
    topics_with_message_count: list[TopicInformation] = field(default_factory=list)
    compression_format: str = ""
    compression_mode: str = ""
    custom_data: dict[str, str] = field(default_factory=dict)
    ros_distro: str = ""

    def __repr__(self) -> str:
        return "\n".join(lines_of(to_bag(self)))


def to_topic(topic: TopicMetadata, count: int = 0) -> bag.Topic:
    """As the room of bags keeps it."""
    qos = tuple(kept(convert_rclcpp_qos_to_rclpy_qos(each)) for each in topic.offered_qos_profiles)
    return bag.Topic(
        topic.name, topic.type, topic.serialization_format, qos, topic.type_description_hash, count
    )


def from_topic(number: int, topic: bag.Topic) -> TopicMetadata:
    """The other way round; `number` is its id in the bag."""
    qos = [QoS._of(offered([each])) for each in topic.qos]
    return TopicMetadata(number, topic.name, topic.type, topic.format, qos, topic.hash)


def to_bag(found: BagMetadata) -> bag.Metadata:
    """As the room of bags keeps it."""
    spans = {each.path: _file_span(each) for each in found.files}
    return bag.Metadata(
        storage=found.storage_identifier,
        topics=tuple(
            to_topic(each.topic_metadata, each.message_count)
            for each in found.topics_with_message_count
        ),
        files=tuple(
            bag.File(name, spans.get(name, bag.MessageSpan())) for name in found.relative_file_paths
        ),
        span=_span(found.message_count, found.starting_time, found.duration.nanoseconds),
        compression_format=found.compression_format,
        compression_mode=found.compression_mode,
        custom=found.custom_data,
        distro=found.ros_distro,
        version=found.version,
        size=found.bag_size,
    )


def _file_span(file: FileInformation) -> bag.MessageSpan:
    duration_ns = file.duration // timedelta(microseconds=1) * 1000
    return _span(file.message_count, file.starting_time, duration_ns)


def _span(count: int, start: Any, duration_ns: int) -> bag.MessageSpan:
    if not count:
        return bag.MessageSpan()
    return bag.MessageSpan(count, start.nanoseconds, start.nanoseconds + duration_ns)


def from_bag(found: bag.Metadata) -> BagMetadata:
    """The other way round."""
    from rclpy.duration import Duration as Of
    from rclpy.time import Time

    return BagMetadata(
        version=found.version,
        bag_size=found.size,
        storage_identifier=found.storage,
        relative_file_paths=[file.name for file in found.files],
        files=[_from_file(file) for file in found.files],
        duration=Of(nanoseconds=found.span.duration_ns),
        starting_time=Time(nanoseconds=found.span.first_ns),
        message_count=found.span.count,
        topics_with_message_count=[
            TopicInformation(from_topic(number, topic), topic.count)
            for number, topic in enumerate(found.topics, 1)
        ],
        compression_format=found.compression_format,
        compression_mode=found.compression_mode,
        custom_data=dict(found.custom),
        ros_distro=found.distro,
    )


def _from_file(file: bag.File) -> FileInformation:
    from rclpy.time import Time

    duration = timedelta(microseconds=file.span.duration_ns / 1000)
    start = Time(nanoseconds=file.span.first_ns)
    return FileInformation(file.name, start, duration, file.span.count)


class MetadataIo:
    """Reads and writes metadata.yaml."""

    def metadata_file_exists(self, uri: str) -> bool:
        """Whether the folder has one."""
        return (Path(uri) / bag.NAME).is_file()

    def read_metadata(self, uri: str) -> BagMetadata:
        """What it says. Raises RuntimeError."""
        with as_runtime_error():
            return from_bag(read_metadata(Path(uri)))

    def write_metadata(self, uri: str, metadata: BagMetadata) -> None:
        """Write it. Raises RuntimeError."""
        with as_runtime_error():
            write_metadata(Path(uri), to_bag(metadata))

    def serialize_metadata(self, metadata: BagMetadata) -> str:
        """Its text."""
        return bag.as_yaml(to_bag(metadata))

    def deserialize_metadata(self, text: str) -> BagMetadata:
        """What a text says. Raises RuntimeError."""
        import yaml

        with as_runtime_error():
            return from_bag(bag.from_plain(yaml.safe_load(text)[bag.ROOT]))


def get_default_storage_id() -> str:
    """How a bag is stored where nothing is said."""
    return "mcap"


def to_rclcpp_qos_vector(text: str, version: int) -> list[QoS]:
    """The profiles in the YAML that a bag keeps for a topic."""
    from rosbags.rosbag2.metadata import parse_qos

    return [QoS._of(offered([each])) for each in parse_qos(text)]
