"""Steps and times of ROS for tests."""

from __future__ import annotations

from typing import Any

from builtin_interfaces.msg import Time as TimeMessage
from rclpy.duration import Duration
from rclpy.time import Time

from ros2_on_pip.stand_ins._frames.buffer_core import stamped
from ros2_on_pip.stand_ins._frames.euler import from_euler
from ros2_on_pip.stand_ins._frames.motion import RigidTransform

SECOND_NS = 1_000_000_000
NEWEST = Time()


def step(
    parent: str, child: str, time_s: float = 0.0, x_m: float = 1.0, yaw_rad: float = 0.0
) -> Any:
    """A TransformStamped: so far ahead, and turned to the left."""
    motion = RigidTransform((x_m, 0.0, 0.0), from_euler((0.0, 0.0, yaw_rad)))
    return stamped(motion, parent, child, round(time_s * SECOND_NS))


def at(time_s: float) -> Time:
    """rclpy's."""
    return Time(nanoseconds=round(time_s * SECOND_NS))


def as_message(time_s: float) -> TimeMessage:
    """That of a header."""
    return at(time_s).to_msg()


def for_s(duration_s: float) -> Duration:
    """rclpy's."""
    return Duration(nanoseconds=round(duration_s * SECOND_NS))
