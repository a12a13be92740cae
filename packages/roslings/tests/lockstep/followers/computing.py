"""Computes for each command: so many seconds of a processor as its parameter says."""

import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node


class Follower(Node):
    """A command twice a second of robot time."""

    def __init__(self) -> None:
        super().__init__("follower")
        self.computes_s = self.declare_parameter("computes_s", 0.1).value
        self.turns = 0
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.5, self.step)

    def step(self) -> None:
        """Work, then speak."""
        ends_s = time.thread_time() + self.computes_s
        while time.thread_time() < ends_s:
            pass
        self.turns += 1
        command = Twist()
        command.linear.x = 0.01 * self.turns
        self.publisher.publish(command)


rclpy.init()
rclpy.spin(Follower())
