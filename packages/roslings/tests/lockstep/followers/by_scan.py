"""Answers each scan with a command."""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class Follower(Node):
    """No timer at all."""

    def __init__(self) -> None:
        super().__init__("follower")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(LaserScan, "scan", self.hear, qos_profile_sensor_data)

    def hear(self, scan: LaserScan) -> None:
        """Keep the left side at 0.8 m."""
        left_m = min(min(scan.ranges[60:120]), 3.0)
        command = Twist()
        command.linear.x = 0.25 if min(scan.ranges[:20]) > 0.5 else 0.0
        command.angular.z = max(-1.0, min(1.0, left_m - 0.8))
        self.publisher.publish(command)


rclpy.init()
rclpy.spin(Follower())
