"""The wheels: a node called wheels. It hears orders on /cmd_vel."""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node


class Wheels(Node):
    def __init__(self):
        super().__init__("wheels")
        self.create_subscription(Twist, "cmd_val", self.drive, 10)

    def drive(self, order):
        print(f"forward {order.linear.x:.1f} m/s")


def main():
    rclpy.init()
    rclpy.spin(Wheels())


main()
