"""Write a drive into a bag, as a recorder beside the rover would have done."""

from __future__ import annotations

import functools
import importlib
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ros2_on_pip.rosbag2.metadata import Topic
from ros2_on_pip.rosbag2.quality import kept
from ros2_on_pip.rosbag2.writing import BagWriter, BagWriterOptions
from roslings_rover.models.drives.recording import NS, RecordedMessage
from roslings_rover.models.drives.unknown import Held, RecordedDrive

DEPTH = 10
STRANGE = bytes(24)
"""The content of a message whose type nobody has."""


def write_drive(
    drive: RecordedDrive, folder: Path, storage: str = "mcap", split_after_s: float = 0.0
) -> None:
    """Make the folder, and the bag in it. Raises BagError."""
    from rclpy.serialization import serialize_message

    bag = BagWriter(folder, BagWriterOptions(storage=storage, max_duration_s=split_after_s))
    try:
        types = {topic.name: topic.type for topic in drive.topics}
        for topic in drive.topics:
            bag.add_topic(Topic(topic.name, topic.type, qos=(kept(_profile(topic)),)))
        for said in drive.said:
            message = message_of(types[said.topic], said)
            data = STRANGE if message is None else serialize_message(message)
            bag.write(said.topic, said.time_ns, data)
    finally:
        bag.close()


def _profile(topic: Held) -> Any:
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    return QoSProfile(
        depth=DEPTH,
        reliability=ReliabilityPolicy.RELIABLE if topic.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if topic.kept else DurabilityPolicy.VOLATILE,
    )


def message_of(type_: str, said: RecordedMessage) -> Any:
    """The message of ROS; None for a type that is not installed."""
    fill = _FILLS.get(type_)
    if fill is None:
        return None
    message = _class_of(type_)()
    if hasattr(message, "header"):
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(said.stamp_ns, NS)
        message.header.frame_id = said.frame
    fill(message, *said.values)
    return message


@functools.cache
def _class_of(type_: str) -> Any:
    package, _, name = type_.split("/")
    return getattr(importlib.import_module(f"{package}.msg"), name)


def _twist(message: Any, forward_m_s: float, turn_rad_s: float) -> None:
    message.linear.x, message.angular.z = forward_m_s, turn_rad_s


def _wheels(message: Any, left_rad_s: float, right_rad_s: float) -> None:
    message.name = ["left_wheel", "right_wheel"]
    message.velocity = [left_rad_s, right_rad_s]


def _odometry(
    message: Any, forward_m_s: float, turn_rad_s: float, x_m: float, y_m: float, heading: float
) -> None:
    message.child_frame_id = "base_link"
    _twist(message.twist.twist, forward_m_s, turn_rad_s)
    pose = message.pose.pose
    pose.position.x, pose.position.y = x_m, y_m
    pose.orientation.z, pose.orientation.w = math.sin(heading / 2), math.cos(heading / 2)


def _imu(message: Any, turn_rad_s: float) -> None:
    message.angular_velocity.z = turn_rad_s


def _range(message: Any, distance: float) -> None:
    message.radiation_type = message.ULTRASOUND
    message.field_of_view, message.min_range, message.max_range = 0.26, 0.02, 4.0
    message.range = distance


def _battery(message: Any, voltage: float, percentage: float) -> None:
    message.present, message.voltage, message.percentage = True, voltage, percentage


def _temperature(message: Any, temperature: float) -> None:
    message.temperature = temperature


def _light(message: Any, illuminance: float) -> None:
    message.illuminance = illuminance


def _bool(message: Any, value: float) -> None:
    message.data = bool(value)


def _text(message: Any, value: float) -> None:
    message.data = f"<robot name='rover' version='{value:g}'/>"


_FILLS: dict[str, Callable[..., None]] = {
    "geometry_msgs/msg/Twist": _twist,
    "sensor_msgs/msg/JointState": _wheels,
    "nav_msgs/msg/Odometry": _odometry,
    "sensor_msgs/msg/Imu": _imu,
    "sensor_msgs/msg/Range": _range,
    "sensor_msgs/msg/BatteryState": _battery,
    "sensor_msgs/msg/Temperature": _temperature,
    "sensor_msgs/msg/Illuminance": _light,
    "std_msgs/msg/Bool": _bool,
    "std_msgs/msg/String": _text,
}
