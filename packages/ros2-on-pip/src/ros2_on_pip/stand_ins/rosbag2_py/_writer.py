"""Write a bag, message by message."""

from __future__ import annotations

import weakref

from ros2_on_pip.rosbag2.packing import ZSTD
from ros2_on_pip.rosbag2.reindexing import require_storage
from ros2_on_pip.rosbag2.writing import BagWriter, BagWriterOptions, Compression

from ._compression_options import CompressionMode, CompressionOptions
from ._errors import as_runtime_error, path_of
from ._storage import (
    ConverterOptions,
    StorageOptions,
    TopicMetadata,
    get_default_storage_id,
    to_topic,
)

CDR = "cdr"
NOT_OPEN = "Bag is not open. Call open() before writing."


class SequentialWriter:
    """Writes a bag. It is complete after `close`, or when the program ends."""

    _compression: Compression = "none"

    def __init__(self) -> None:
        self._bag: BagWriter | None = None

    def open(self, storage_options: StorageOptions, converter_options: ConverterOptions) -> None:
        """Make the bag's folder. Raises RuntimeError, also where the folder is there already."""
        with as_runtime_error():
            require_storage((), storage_options.storage_id)
        _require_known(storage_options, converter_options)
        plan = BagWriterOptions(
            storage=storage_options.storage_id or get_default_storage_id(),
            compression=self._compression,
            max_size=storage_options.max_bagfile_size,
            max_duration_s=storage_options.max_bagfile_duration,
            custom=storage_options.custom_data,
        )
        with as_runtime_error():
            self._bag = BagWriter(path_of(storage_options.uri), plan)
        self._finish = weakref.finalize(self, self._bag.close)

    def close(self) -> None:
        """Complete the bag; without one nothing happens. Raises RuntimeError."""
        bag, self._bag = self._bag, None
        if bag:
            self._finish.detach()
            with as_runtime_error():
                bag.close()

    def create_topic(self, topic: TopicMetadata) -> None:
        """Before the first message of this topic. Raises RuntimeError."""
        bag = self._require()
        if topic.serialization_format != CDR:
            raise RuntimeError(f"'{topic.serialization_format}' is unknown here; there is only cdr")
        with as_runtime_error():
            bag.add_topic(to_topic(topic))

    def remove_topic(self, topic: TopicMetadata) -> None:
        """Forget a topic, with the messages that it has. Raises RuntimeError for an unknown one."""
        bag = self._require()
        if not bag.has(topic.name):
            raise RuntimeError(f'Failed to remove the non-existing topic "{topic.name}"!')
        with as_runtime_error():
            bag.remove_topic(topic.name)

    def write(self, topic_name: str, message: bytes, timestamp: int) -> None:
        """One message: its bytes (`serialize_message`), and when it came, in ns since 1970.

        Raises RuntimeError, and TypeError where an argument is of another kind.
        """
        bag = self._require()
        if not isinstance(message, bytes):
            raise TypeError(f"write: bytes are wanted, from serialize_message, not {type(message)}")
        if not isinstance(timestamp, int):
            raise TypeError("write: the time is a whole number: get_clock().now().nanoseconds")
        if not bag.has(topic_name):
            raise RuntimeError(
                f"Failed to write on topic '{topic_name}'. Call create_topic() before first write."
            )
        with as_runtime_error():
            bag.write(topic_name, timestamp, message)

    def split_bagfile(self) -> None:
        """The next message goes into a new file. Raises RuntimeError."""
        with as_runtime_error():
            self._require().split()

    def take_snapshot(self) -> bool:
        """False: every message is written at once, so there is nothing to write now."""
        return False

    def _require(self) -> BagWriter:
        if self._bag is None:
            raise RuntimeError(NOT_OPEN)
        return self._bag


class SequentialCompressionWriter(SequentialWriter):
    """The same, compressed."""

    def __init__(self, compression_options: CompressionOptions) -> None:
        """Raises TypeError, and RuntimeError where the options do not compress."""
        super().__init__()
        asked = compression_options
        if not isinstance(asked, CompressionOptions):
            raise TypeError(f"CompressionOptions(...) is wanted, not {asked!r}")
        if asked.compression_mode == CompressionMode.NONE or asked.compression_format != ZSTD:
            raise RuntimeError("a compression needs the format zstd, and the mode FILE or MESSAGE")
        self._compression = "file" if asked.compression_mode == CompressionMode.FILE else "message"


def _require_known(storage: StorageOptions, converter: ConverterOptions) -> None:
    formats = {converter.input_serialization_format, converter.output_serialization_format}
    if not formats <= {"", CDR}:
        raise RuntimeError("there is only the serialization format cdr")
    if storage.snapshot_mode:
        raise RuntimeError(
            "snapshot_mode is part of the full ROS 2: sudo apt install ros-jazzy-rosbag2"
        )


def get_registered_writers() -> set[str]:
    """How bags may be stored that are written."""
    return {"mcap", "sqlite3"}


def get_registered_compressors() -> set[str]:
    """How bags may be compressed."""
    return {ZSTD}


def get_registered_serializers() -> set[str]:
    """How messages may be turned into bytes."""
    return {f"{CDR}_converter"}
