"""A laser sits in the middle of a rover, and is turned 90 degrees to the left. It sees
a nail 1 m ahead of itself. Print where the nail is for the rover:
"nail at 0.00, 1.00"."""

import math

from geometry_msgs.msg import PointStamped, TransformStamped
from tf2_geometry_msgs import do_transform_point


def mount(degrees):
    """Where the laser sits on the rover."""
    half = degrees / 2
    step = TransformStamped(child_frame_id="laser")
    step.header.frame_id = "base_link"
    step.transform.rotation.z = math.sin(half)
    step.transform.rotation.w = math.cos(half)
    return step


def main():
    nail = PointStamped()
    nail.header.frame_id = "laser"
    nail.point.x = 1.0
    seen = do_transform_point(nail, mount(90)).point
    print(f"nail at {seen.x:.2f}, {seen.y:.2f}")


main()
