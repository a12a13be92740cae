"""What the rover says, as ROS messages; the frames in which it says it, and how often.

Labs say the same of their own rovers, and take it from here. No lab is measured with the rover's
node: that may change without them.
"""

from __future__ import annotations

import array
import math
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from roslings_rover.models.differential_drive import Motion, Pose
    from roslings_rover.rover.rover import Rover

ODOM_FRAME, BODY_FRAME, LASER_FRAME = "odom", "base_link", "laser"
STEP_S = 0.02
ODOM_EVERY_S = 0.05
LONGEST_PAUSE_S = 0.25
"""A computer that slept, or a stopped process, does not let the rover leap."""

QUIET = ["--ros-args", "--disable-external-lib-logs", "--disable-stdout-logs"]
"""The map is on the screen: log lines would tear it, and files in ~/.ros nobody tidies."""


class InMotion(Protocol):
    """Something that is somewhere, and moves: a rover, or what it believes of itself."""

    @property
    def pose(self) -> Pose:
        """Where it is."""
        ...

    @property
    def motion(self) -> Motion:
        """How it moves."""
        ...


def odometry(moving: InMotion, stamp: Any) -> Any:
    """A nav_msgs/msg/Odometry of where something is and how it moves."""
    from nav_msgs.msg import Odometry

    told = Odometry(child_frame_id=BODY_FRAME)
    told.header.stamp, told.header.frame_id = stamp, ODOM_FRAME
    place, pose = told.pose.pose, moving.pose
    place.position.x, place.position.y = pose.x_m, pose.y_m
    turn(place.orientation, pose.heading_rad)
    told.twist.twist.linear.x = moving.motion.forward_m_s
    told.twist.twist.angular.z = moving.motion.turn_rad_s
    return told


def turn(quaternion: Any, angle_rad: float) -> None:
    """A turn about the upright axis: z = sin(a / 2), w = cos(a / 2)."""
    quaternion.z, quaternion.w = math.sin(angle_rad / 2), math.cos(angle_rad / 2)


def laser_scan(rover: Rover, stamp: Any) -> Any:
    """A sensor_msgs/msg/LaserScan of what the scanner reads: a turn of it, in metres."""
    from sensor_msgs.msg import LaserScan

    scanner = rover.scanner
    scan = LaserScan(
        angle_min=0.0,
        angle_max=scanner.step_rad * (scanner.rays - 1),
        angle_increment=scanner.step_rad,
        scan_time=1 / scanner.turns_hz,
        range_min=scanner.nearest_m,
        range_max=scanner.farthest_m,
        ranges=array.array("f", rover.scan()),  # it is sent in a fifth of a list's time
    )
    scan.header.stamp, scan.header.frame_id = stamp, LASER_FRAME
    return scan
