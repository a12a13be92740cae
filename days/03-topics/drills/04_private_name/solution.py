"""Foretell: on which full name does this node publish? Write it between quotes."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32

ANSWER = "/yard/mast/air"


class Mast(Node):
    def __init__(self):
        super().__init__("mast", namespace="yard")
        self.publisher = self.create_publisher(Float32, "~/air", 10)
        self.timer = self.create_timer(0.2, self.tell)

    def tell(self):
        self.publisher.publish(Float32(data=0.62))


def main():
    rclpy.init()
    rclpy.spin(Mast())


main()
