"""Where frames are, told and looked up: with the names of Jazzy's `tf2_ros`.

A buffer works without `tf2_msgs`. What speaks or hears on /tf asks for it when it is made
(`_tf_message.py`).
"""

from __future__ import annotations

from typing import NoReturn

from ros2_on_pip.stand_ins._frames.buffer_core import BufferCore
from ros2_on_pip.stand_ins._frames.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

from .buffer import Buffer
from .buffer_interface import (
    BufferInterface,
    ConvertRegistration,
    NotImplementedException,
    Stamped,
    TransformRegistration,
    TypeException,
    convert,
)
from .static_transform_broadcaster import StaticTransformBroadcaster
from .transform_broadcaster import TransformBroadcaster
from .transform_listener import TransformListener

__all__ = [
    "Buffer",
    "BufferCore",
    "BufferInterface",
    "ConnectivityException",
    "ConvertRegistration",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "NotImplementedException",
    "Stamped",
    "StaticTransformBroadcaster",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
    "TransformRegistration",
    "TypeException",
    "convert",
]

_INSTEAD = {"BufferClient": "Buffer and TransformListener, in each node that looks up"}
"""What Jazzy has and this package has not, and what does the same."""


def __getattr__(name: str) -> NoReturn:
    if name in _INSTEAD:
        raise ImportError(
            f"tf2_ros.{name} is part of the full ROS 2, which needs Ubuntu 24.04:"
            f" sudo apt install ros-jazzy-tf2-ros-py. Here, use instead: {_INSTEAD[name]}"
        )
    raise AttributeError(f"module 'tf2_ros' has no attribute {name!r}")
