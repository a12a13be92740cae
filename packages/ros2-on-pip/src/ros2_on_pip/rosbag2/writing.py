"""Write a bag: a folder with numbered files of messages, and metadata.yaml when it is complete."""

from __future__ import annotations

import os
import sqlite3
import time
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

from ros2_on_pip.rosbag2.definition import definition_of
from ros2_on_pip.rosbag2.errors import BagError, BagNotWritable, BagThere, TooSmall
from ros2_on_pip.rosbag2.files import LEAST_SPLIT, StorageFile, new_file
from ros2_on_pip.rosbag2.metadata import (
    ENDINGS,
    VERSION,
    File,
    MessageSpan,
    Metadata,
    Topic,
    as_plain,
)
from ros2_on_pip.rosbag2.packing import ZSTD, packed, packed_file
from ros2_on_pip.rosbag2.reindexing import place_of_metadata, reindex, write_metadata

Compression = Literal["none", "file", "message"]

SETTLE_EVERY_S = 1.0
"""So much is lost at most where the power goes, or where the disk is full."""

EXTRA_BYTES = 40
"""What a message needs in a file beside its own bytes, in round numbers."""

RESERVE_BYTES = 64 * 1024

FAULTS = (OSError, sqlite3.Error)


@dataclass(frozen=True)
class BagWriterOptions:
    """How a bag is written. Zero stands for no limit."""

    storage: str = "mcap"
    compression: Compression = "none"
    max_size: int = 0
    """Bytes of a file before the next one begins."""
    max_duration_s: float = 0.0
    """Between the first message of a file and the first of the next."""
    custom: Mapping[str, str] = field(default_factory=dict)

    def require_sense(self) -> None:
        """Raises TooSmall."""
        least = LEAST_SPLIT[self.storage]
        if 0 < self.max_size < least:
            raise TooSmall(self.max_size, least)


class BagWriter:
    """A bag that is being written. `close` completes it; until then it has no metadata.yaml."""

    def __init__(self, folder: Path, plan: BagWriterOptions) -> None:
        """Make the folder. Raises BagThere, BagNotWritable, TooSmall, BadBagPath."""
        plan.require_sense()
        self.folder, self.plan = folder, plan
        self._topics: dict[str, Topic] = {}
        self._connections: dict[str, Any] = {}
        self._counts: dict[str, int] = {}
        self._files: list[File] = []
        self._span = MessageSpan()
        self._last_id = 0
        self._failed = self._closed = False
        self._make_folder()
        self._begin()

    def _make_folder(self) -> None:
        if self.folder.exists():
            raise BagThere(self.folder)
        try:
            self.folder.mkdir(parents=True)
            self._reserve()
        except OSError as fault:
            raise BagNotWritable(self.folder, fault) from fault

    def _reserve(self) -> None:
        """Keep room for the end: on a full disk, metadata.yaml and the last index fit in there."""
        with place_of_metadata(self.folder).open("wb") as reserve:
            os.posix_fallocate(reserve.fileno(), 0, RESERVE_BYTES)

    @property
    def file(self) -> Path:
        """The file that is being written."""
        return self._storage.path

    def has(self, topic: str) -> bool:
        """Whether it has been added."""
        return topic in self._topics

    def remove_topic(self, topic: str) -> None:
        """Leave it out of the list of contents, with the messages that it has.

        Raises BagNotWritable, and KeyError for a topic that was not added.
        """
        for kept in (self._topics, self._connections, self._counts):
            kept.pop(topic)
        self._guarded(lambda: self._storage.forget(topic))

    def add_topic(self, topic: Topic) -> None:
        """Before its first message. A second time nothing happens. Raises BagNotWritable."""
        if topic.name not in self._topics:
            definition = definition_of(topic.type)
            self._topics[topic.name] = replace(topic, hash=topic.hash or definition.hash)
            self._counts[topic.name] = 0
            self._guarded(lambda: self._connect(self._topics[topic.name], definition.text))

    def write(self, topic: str, time_ns: int, data: bytes) -> None:
        """One message, as ROS serialises it, and when it came.

        Raises BagNotWritable, and KeyError for a topic that was not added.
        """
        connection = self._connections[topic]
        self._guarded(lambda: self._write(connection, time_ns, data))
        self._counts[topic] += 1
        self._span = self._span.with_one(time_ns)

    def settle(self) -> None:
        """What was written survives from here on, whatever happens. Raises BagNotWritable."""
        self._guarded(self._storage.settle)

    def keep_settled(self) -> None:
        """The same, at most once in SETTLE_EVERY_S: for those who wait for the next message."""
        self._guarded(self._settle_if_due)

    def split(self) -> None:
        """The next message goes into a new file. Raises BagNotWritable."""
        self._guarded(self._split)

    def close(self) -> None:
        """Complete the bag; a second time nothing happens.

        Where writing has failed, what could be written is made a whole bag. Raises BagNotWritable.
        """
        if self._closed:
            return
        self._closed = True
        place_of_metadata(self.folder).unlink(missing_ok=True)
        if self._failed:
            self._save_what_is_left()
        else:
            self._guarded(self._complete)

    def _guarded(self, step: Any) -> None:
        try:
            step()
        except (BagError, *FAULTS) as fault:
            self._failed = True
            if self._closed:
                self._save_what_is_left()
            if isinstance(fault, BagError):
                raise
            raise BagNotWritable(self.folder, fault) from fault

    def _save_what_is_left(self) -> None:
        with suppress(*FAULTS):
            self._storage.abort()
        with suppress(BagError, *FAULTS):
            reindex(self.folder)

    def _begin(self) -> None:
        """The next file."""
        number, ending = len(self._files), ENDINGS[self.plan.storage]
        file = self.folder / f"{self.folder.name}_{number}{ending}"
        self._span, self._bytes, self._types = MessageSpan(), 0, set[str]()
        self._settled_s = time.monotonic()
        try:
            self._storage: StorageFile = new_file(file, self.plan.storage)
        except FAULTS as fault:
            raise BagNotWritable(self.folder, fault) from fault
        for connection in self._connections.values():
            self._introduce(connection)

    def _connect(self, topic: Topic, text: str) -> None:
        from rosbags.interfaces import (
            Connection,
            ConnectionExtRosbag2,
            MessageDefinition,
            MessageDefinitionFormat,
        )

        self._connections[topic.name] = Connection(
            self._next_id(),
            topic.name,
            topic.type,
            MessageDefinition(MessageDefinitionFormat.MSG, text),
            topic.hash,
            0,
            ConnectionExtRosbag2(topic.format, list(topic.qos)),
            self,
        )
        self._introduce(self._connections[topic.name])

    def _next_id(self) -> int:
        self._last_id += 1
        return self._last_id

    def _introduce(self, connection: Any) -> None:
        if connection.msgtype not in self._types:
            self._storage.add_msgtype(connection)
            self._types.add(connection.msgtype)
        self._storage.add_connection(connection, _qos_text(connection.ext.offered_qos_profiles))

    def _write(self, connection: Any, time_ns: int, data: bytes) -> None:
        if self.plan.compression == "message":
            data = packed(data)
        if self._is_full(time_ns):
            self._split()
        self._storage.write(connection, time_ns, data)
        self._bytes += len(data) + EXTRA_BYTES
        self._settle_if_due()

    def _settle_if_due(self) -> None:
        if time.monotonic() - self._settled_s >= SETTLE_EVERY_S:
            self._storage.settle()
            self._settled_s = time.monotonic()

    def _is_full(self, time_ns: int) -> bool:
        plan, span = self.plan, self._span
        if not span.count:
            return False
        late = time_ns - span.first_ns > plan.max_duration_s * 1e9 > 0
        return late or self._bytes >= plan.max_size > 0

    def _split(self) -> None:
        self._end_file()
        self._begin()

    def _end_file(self) -> None:
        """The file that was being written is whole."""
        ended = File(self.file.name, self._span)
        self._files.append(ended)
        self._storage.close(VERSION, _inner_yaml(self._metadata()))
        if self.plan.compression == "file":
            self._files[-1] = replace(ended, name=packed_file(self.file).name)

    def _complete(self) -> None:
        self._end_file()
        write_metadata(self.folder, self._metadata())

    def _metadata(self) -> Metadata:
        mode = self.plan.compression.upper()
        span = sum((file.span for file in self._files), MessageSpan())
        return Metadata(
            storage=self.plan.storage,
            topics=tuple(
                replace(topic, count=self._counts[name]) for name, topic in self._topics.items()
            ),
            files=tuple(self._files),
            span=replace(span, count=sum(self._counts.values())),
            compression_format="" if mode == "NONE" else ZSTD,
            compression_mode="" if mode == "NONE" else mode,
            custom=self.plan.custom,
        )


def _inner_yaml(metadata: Metadata) -> str:
    """The copy of it that each file holds."""
    import yaml

    return str(yaml.safe_dump(as_plain(metadata), sort_keys=False)).strip()


def _qos_text(qos: list[Any]) -> str:
    """As a file keeps it: YAML."""
    import yaml
    from rosbags.rosbag2.metadata import dump_qos_v9

    return str(yaml.safe_dump(dump_qos_v9(qos))).strip()
