"""A display: a node called display. It listens to /speed. The wheels publish there
with a plain 10: reliable, and nothing is kept for those who come late."""

import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float32


class Display(Node):
    def __init__(self):
        super().__init__("display")
        kept = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(Float32, "speed", self.show, kept)

    def show(self, speed):
        print(f"{speed.data:.1f} m/s")


def main():
    rclpy.init()
    rclpy.spin(Display())


main()
