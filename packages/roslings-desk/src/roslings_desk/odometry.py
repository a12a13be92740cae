"""Where a robot says that it is."""

from __future__ import annotations

import math
from typing import Any

from roslings_rover.models.differential_drive import Pose

ODOM, ODOMETRY = "/odom", "nav_msgs/msg/Odometry"


def pose_in(odometry: Any) -> Pose | None:
    """Where a nav_msgs/msg/Odometry says that the robot is; None where a number is not finite."""
    place = odometry.pose.pose
    z, w = place.orientation.z, place.orientation.w
    pose = Pose(place.position.x, place.position.y, 2 * math.atan2(z, w))
    numbers = (pose.x_m, pose.y_m, pose.heading_rad)
    if not all(map(math.isfinite, numbers)):
        return None
    return Pose(pose.x_m, pose.y_m, math.remainder(pose.heading_rad, math.tau))
