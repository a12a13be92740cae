"""Foretell: which full name has this node? Write it between quotes, then check."""

import rclpy
from rclpy.node import Node

ANSWER = "/left/front/wheel"


class Wheel(Node):
    def __init__(self):
        super().__init__("wheel", namespace="left/front")


def main():
    rclpy.init()
    rclpy.spin(Wheel())


main()
