"""Read and write bags from Python, with the names of Jazzy's `rosbag2_py`."""

from __future__ import annotations

from typing import NoReturn

try:
    import rosbags  # noqa: F401
except ModuleNotFoundError as missing:
    raise ImportError(
        "rosbag2_py needs the Python package rosbags, which is not installed yet."
        " In this terminal type once: ros2 node list"
    ) from missing

from ._compression_options import CompressionMode, CompressionOptions
from ._info import Info
from ._reader import SequentialCompressionReader, SequentialReader, get_registered_readers
from ._reindexer import Reindexer
from ._storage import (
    BagMetadata,
    ConverterOptions,
    FileInformation,
    MessageDefinition,
    MetadataIo,
    ReadOrder,
    ReadOrderSortBy,
    StorageFilter,
    StorageOptions,
    TopicInformation,
    TopicMetadata,
    get_default_storage_id,
)
from ._writer import (
    SequentialCompressionWriter,
    SequentialWriter,
    get_registered_compressors,
    get_registered_serializers,
    get_registered_writers,
)

__all__ = [
    "BagMetadata",
    "CompressionMode",
    "CompressionOptions",
    "ConverterOptions",
    "FileInformation",
    "Info",
    "MessageDefinition",
    "MetadataIo",
    "ReadOrder",
    "ReadOrderSortBy",
    "Reindexer",
    "SequentialCompressionReader",
    "SequentialCompressionWriter",
    "SequentialReader",
    "SequentialWriter",
    "StorageFilter",
    "StorageOptions",
    "TopicInformation",
    "TopicMetadata",
    "get_default_storage_id",
    "get_registered_compressors",
    "get_registered_readers",
    "get_registered_serializers",
    "get_registered_writers",
]

_INSTEAD = {
    "LocalMessageDefinitionSource": "ros2 interface show TYPE",
    "PlayOptions": "the command ros2 bag play",
    "Player": "the command ros2 bag play",
    "RecordOptions": "the command ros2 bag record",
    "Recorder": "the command ros2 bag record, or SequentialWriter in a node",
    "ServiceRequestsSource": "the command ros2 service call",
    "bag_rewrite": "SequentialReader and SequentialWriter",
}
"""What Jazzy has and this package has not, and what does the same."""


def __getattr__(name: str) -> NoReturn:
    if name in _INSTEAD:
        raise ImportError(
            f"rosbag2_py.{name} is part of the full ROS 2, which needs Ubuntu 24.04:"
            f" sudo apt install ros-jazzy-rosbag2-py. Here, use instead: {_INSTEAD[name]}"
        )
    raise AttributeError(f"module 'rosbag2_py' has no attribute {name!r}")
