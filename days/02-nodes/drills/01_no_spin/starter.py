"""The rover's lamp: a node called rover_lamp, which runs until Ctrl-C."""

import rclpy
from rclpy.node import Node


class RoverLamp(Node):
    def __init__(self):
        super().__init__("rover_lamp")
        self.get_logger().info("The lamp is on.")


def main():
    rclpy.init()
    RoverLamp()


main()
