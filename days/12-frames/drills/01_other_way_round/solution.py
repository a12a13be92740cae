"""A laser sits on a rover, 0.20 m ahead of its middle. It sees a nail 1.00 m ahead of
itself. Print how far ahead of the rover's middle the nail is: "nail at 1.20 m"."""

from geometry_msgs.msg import PointStamped, TransformStamped
from rclpy.time import Time
from tf2_geometry_msgs import do_transform_point
from tf2_ros import Buffer


def mount():
    """Where the laser sits on the rover."""
    step = TransformStamped(child_frame_id="laser")
    step.header.frame_id = "base_link"
    step.transform.translation.x = 0.20
    return step


def main():
    buffer = Buffer()
    buffer.set_transform_static(mount(), "drill")
    nail = PointStamped()
    nail.header.frame_id = "laser"
    nail.point.x = 1.00
    transform = buffer.lookup_transform("base_link", "laser", Time())
    print(f"nail at {do_transform_point(nail, transform).point.x:.2f} m")


main()
