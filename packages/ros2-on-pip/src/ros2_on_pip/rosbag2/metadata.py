"""metadata.yaml: the list of what a bag holds, as rosbag2 of Jazzy writes it (version 9)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

NAME = "metadata.yaml"
ROOT = "rosbag2_bagfile_information"
VERSION = 9
DISTRO = "jazzy"
NEVER_NS = 2**63 - 1
"""The beginning of a bag without messages."""

ENDINGS = {"mcap": ".mcap", "sqlite3": ".db3"}
"""Name of a storage to how its files end."""


@dataclass(frozen=True)
class Topic:
    """A topic of a bag. `qos` holds what its publishers offered, as `rosbags` keeps it."""

    name: str
    type: str
    format: str = "cdr"
    qos: tuple[Any, ...] = ()
    hash: str = ""
    count: int = 0


@dataclass(frozen=True)
class MessageSpan:
    """Messages between the first and the last stamp, in nanoseconds since 1970."""

    count: int = 0
    first_ns: int = NEVER_NS
    last_ns: int = 0

    @property
    def duration_ns(self) -> int:
        """From the first to the last."""
        return max(0, self.last_ns - self.first_ns)

    def with_one(self, time_ns: int) -> MessageSpan:
        """One message more."""
        first_ns, last_ns = min(self.first_ns, time_ns), max(self.last_ns, time_ns)
        return MessageSpan(self.count + 1, first_ns, last_ns)

    def __add__(self, other: MessageSpan) -> MessageSpan:
        first_ns, last_ns = min(self.first_ns, other.first_ns), max(self.last_ns, other.last_ns)
        return MessageSpan(self.count + other.count, first_ns, last_ns)


@dataclass(frozen=True)
class File:
    """A file of a bag; `name` is relative to the bag's folder."""

    name: str
    span: MessageSpan = MessageSpan()


@dataclass(frozen=True)
class Metadata:
    """What a bag holds."""

    storage: str = ""
    topics: tuple[Topic, ...] = ()
    files: tuple[File, ...] = ()
    span: MessageSpan = MessageSpan()
    compression_format: str = ""
    compression_mode: str = ""
    custom: Mapping[str, str] = field(default_factory=dict)
    distro: str = DISTRO
    version: int = VERSION
    size: int = 0
    """All files together, in bytes."""

    def measured(self, folder: Path) -> Metadata:
        """With the size of the files as they lie in `folder`."""
        sizes = [(folder / file.name).stat().st_size for file in self.files]
        return replace(self, size=sum(sizes))


def as_yaml(metadata: Metadata) -> str:
    """The text of metadata.yaml."""
    import yaml

    return str(yaml.safe_dump({ROOT: as_plain(metadata)}, sort_keys=False))


def as_plain(metadata: Metadata) -> dict[str, Any]:
    """With the keys of rosbag2, in its order."""
    return {
        "version": metadata.version,
        "storage_identifier": metadata.storage,
        **_span(metadata.span),
        "topics_with_message_count": [_topic(topic) for topic in metadata.topics],
        "compression_format": metadata.compression_format,
        "compression_mode": metadata.compression_mode,
        "relative_file_paths": [file.name for file in metadata.files],
        "files": [{"path": file.name, **_span(file.span)} for file in metadata.files],
        "custom_data": dict(metadata.custom) or None,
        "ros_distro": metadata.distro,
    }


def _span(span: MessageSpan) -> dict[str, Any]:
    return {
        "duration": {"nanoseconds": span.duration_ns},
        "starting_time": {"nanoseconds_since_epoch": span.first_ns},
        "message_count": span.count,
    }


def _topic(topic: Topic) -> dict[str, Any]:
    from rosbags.rosbag2.metadata import dump_qos_v9

    return {
        "topic_metadata": {
            "name": topic.name,
            "type": topic.type,
            "serialization_format": topic.format,
            "offered_qos_profiles": dump_qos_v9(list(topic.qos)),
            "type_description_hash": topic.hash,
        },
        "message_count": topic.count,
    }


def from_plain(plain: Mapping[str, Any]) -> Metadata:
    """What stands below the root of metadata.yaml, of any version.

    Raises KeyError, TypeError, ValueError.
    """
    return Metadata(
        storage=plain["storage_identifier"],
        topics=tuple(_read_topic(each) for each in plain["topics_with_message_count"]),
        files=tuple(_files(plain)),
        span=_read_span(plain),
        compression_format=plain.get("compression_format") or "",
        compression_mode=plain.get("compression_mode") or "",
        custom=plain.get("custom_data") or {},
        distro=plain.get("ros_distro") or "",
        version=plain["version"],
    )


def _files(plain: Mapping[str, Any]) -> Sequence[File]:
    """Before version 5 only the names were kept; before version 4 with the bag's folder."""
    names = [Path(name).name for name in plain["relative_file_paths"]]
    spans = {Path(each["path"]).name: _read_span(each) for each in plain.get("files") or ()}
    return [File(name, spans.get(name, MessageSpan())) for name in names]


def _read_span(plain: Mapping[str, Any]) -> MessageSpan:
    count, duration_ns = int(plain["message_count"]), int(plain["duration"]["nanoseconds"])
    first_ns = int(plain["starting_time"]["nanoseconds_since_epoch"])
    return MessageSpan(count, first_ns, first_ns + duration_ns) if count else MessageSpan()


def _read_topic(plain: Mapping[str, Any]) -> Topic:
    from rosbags.rosbag2.metadata import parse_qos

    about = plain["topic_metadata"]
    return Topic(
        name=about["name"],
        type=about["type"],
        format=about["serialization_format"],
        qos=tuple(parse_qos(about.get("offered_qos_profiles") or [])),
        hash=about.get("type_description_hash") or "",
        count=int(plain["message_count"]),
    )
