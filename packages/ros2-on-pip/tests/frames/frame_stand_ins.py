"""The packages by ROS's own names, as each environment of ours has them on its path."""

from __future__ import annotations

import sys

from sources import code_of

STAND_INS = code_of("ros2_on_pip") / "stand_ins"
sys.path.append(str(STAND_INS))

import tf2_geometry_msgs  # noqa: E402  the folder is on the path of every environment of ours
import tf2_py  # noqa: E402
import tf2_ros  # noqa: E402
import tf_transformations  # noqa: E402

__all__ = ["STAND_INS", "tf2_geometry_msgs", "tf2_py", "tf2_ros", "tf_transformations"]
