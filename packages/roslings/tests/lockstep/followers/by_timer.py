"""Steers by a timer, from the newest scan: away from what is near ahead."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class Follower(Node):
    """One node, one timer."""

    def __init__(self) -> None:
        super().__init__("follower")
        self.scan = None
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(LaserScan, "scan", self.hear, qos_profile_sensor_data)
        self.create_timer(0.1, self.step)

    def hear(self, scan: LaserScan) -> None:
        """Keep it."""
        self.scan = scan

    def step(self) -> None:
        """Ten times a second."""
        if self.scan is None:
            return
        ahead = [*self.scan.ranges[:30], *self.scan.ranges[-30:]]
        near_m = min(r for r in ahead if not math.isnan(r))
        command = Twist()
        command.linear.x = 0.3 if near_m > 0.6 else 0.0
        command.angular.z = 0.4 / max(0.3, min(near_m, 6.0))
        self.publisher.publish(command)


rclpy.init()
rclpy.spin(Follower())
