"""A mount: a node called mount. It tells once where the laser sits on the rover, 0.20 m
ahead of its middle, and stays. A node that starts later must know it, too."""

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import TransformBroadcaster


class Mount(Node):
    def __init__(self):
        super().__init__("mount")
        self.broadcaster = TransformBroadcaster(self)
        step = TransformStamped(child_frame_id="laser")
        step.header.stamp = self.get_clock().now().to_msg()
        step.header.frame_id = "base_link"
        step.transform.translation.x = 0.20
        self.broadcaster.sendTransform(step)


def main():
    rclpy.init()
    rclpy.spin(Mount())


main()
