"""An error after Ctrl-C, each time."""

import sys

import rclpy
from rclpy.executors import ExternalShutdownException

rclpy.init()
node = rclpy.create_node("talker")
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    sys.exit(3)
