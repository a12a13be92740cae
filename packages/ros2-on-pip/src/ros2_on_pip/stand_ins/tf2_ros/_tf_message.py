"""The type of /tf, which no wheel brings."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any


class NoTfMessage(ImportError):
    """`tf2_msgs` is not in this environment."""

    def __init__(self) -> None:
        super().__init__(f"/tf has the type tf2_msgs/msg/TFMessage. {_how_to_get_it()}")


def _how_to_get_it() -> str:
    if os.environ.get("ROS_DISTRO"):
        return "To get it, type once: sudo apt install ros-jazzy-tf2-msgs"
    if (Path(sys.prefix).parent / "roslings").is_file():
        return (
            "No wheel brings it, but the course does. In the roslings folder type once:"
            " ./roslings ready rover --tf"
        )
    return "No wheel brings it: build the package tf2_msgs of geometry2 with colcon, and source it"


def tf_message() -> Any:
    """The class TFMessage. Raises NoTfMessage."""
    try:
        from tf2_msgs.msg import TFMessage
    except ImportError as error:
        raise NoTfMessage from error
    return TFMessage
