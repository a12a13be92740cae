"""It shuts down twice; at its first run the first of the two comes too late, and ends it.

So does rclpy's own try_shutdown(), one time in twenty: its signal handler shuts the context down
in another thread, and may come between the two steps.
"""

from pathlib import Path

import rclpy
from rclpy.executors import ExternalShutdownException

MARK = Path(__file__).with_name("was_here")


def try_shutdown() -> None:
    """As if the context had ended after it was asked whether it has."""
    if MARK.exists():
        rclpy.try_shutdown()
        return
    MARK.touch()
    while rclpy.ok():
        pass
    rclpy.shutdown()


rclpy.init()
node = rclpy.create_node("talker")
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    try_shutdown()
    rclpy.shutdown()
