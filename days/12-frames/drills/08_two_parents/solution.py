"""Foretell: the odometry says where base_link is in odom. A second later another node
says where base_link is in map. After each, the program prints from where base_link can
be found. Which line is written second? Write it as a text, then check."""

from geometry_msgs.msg import TransformStamped
from rclpy.time import Time
from tf2_ros import Buffer

ANSWER = "odom no, map yes"


def step(parent, second):
    told = TransformStamped(child_frame_id="base_link")
    told.header.frame_id = parent
    told.header.stamp.sec = second
    return told


def main():
    buffer = Buffer()
    for second, parent in enumerate(("odom", "map"), 1):
        buffer.set_transform(step(parent, second), parent)
        known = {
            frame: "yes" if buffer.can_transform(frame, "base_link", Time()) else "no"
            for frame in ("odom", "map")
        }
        print(f"odom {known['odom']}, map {known['map']}")


main()
