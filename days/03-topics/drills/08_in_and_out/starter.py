"""Foretell: the distances 0.50, 0.24, 0.27, 0.23, 0.40 and 0.22 come, in this order.
How often does this node write "too near"? Write the number, then check."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32

ANSWER = None
NEAR, FAR = 0.25, 0.30


class Bumper(Node):
    def __init__(self):
        super().__init__("bumper")
        self.near = False
        self.create_subscription(Float32, "distance", self.hear, 10)

    def hear(self, message):
        if not self.near and message.data < NEAR:
            self.near = True
            print("too near")
        elif self.near and message.data > FAR:
            self.near = False
        print(f"heard {message.data:.2f}", flush=True)


def main():
    rclpy.init()
    rclpy.spin(Bumper())


main()
