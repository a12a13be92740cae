"""A lamp that must end well: after Ctrl-C no traceback, and exit code 0."""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node


def main():
    try:
        rclpy.init()
        rclpy.spin(Node("lamp"))
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.shutdown()


main()
