"""A rover's odometry says: the rover is at x 2.0 m, y 0.5 m, in odom. Make the step of
the tree of it, and print where the rover is: "rover at 2.0, 0.5"."""

from geometry_msgs.msg import TransformStamped
from rclpy.time import Time
from tf2_ros import Buffer


def step_to(x, y):
    """Where the rover is, as one step of the tree."""
    step = TransformStamped()
    step.header.frame_id = "base_link"
    step.child_frame_id = "odom"
    step.transform.translation.x = x
    step.transform.translation.y = y
    return step


def main():
    buffer = Buffer()
    buffer.set_transform_static(step_to(2.0, 0.5), "drill")
    found = buffer.lookup_transform("odom", "base_link", Time())
    place = found.transform.translation
    print(f"rover at {place.x:.1f}, {place.y:.1f}")


main()
