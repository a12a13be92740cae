"""The buffer of frames without a node, with the names of Jazzy's `tf2_py`."""

from ros2_on_pip.stand_ins._frames.buffer_core import BufferCore
from ros2_on_pip.stand_ins._frames.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

__all__ = [
    "BufferCore",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "TimeoutException",
    "TransformException",
]
