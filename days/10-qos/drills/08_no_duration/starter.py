"""A clock: a node called clock_tower. It publishes on /bell, 5 times a second, and
promises that never more than half a second lies between two messages."""

import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import Empty

PROMISED = QoSProfile(depth=10, deadline=0.5)


class ClockTower(Node):
    def __init__(self):
        super().__init__("clock_tower")
        self.bell = self.create_publisher(Empty, "bell", PROMISED)
        self.create_timer(0.2, self.ring)

    def ring(self):
        self.bell.publish(Empty())


def main():
    rclpy.init()
    rclpy.spin(ClockTower())


main()
