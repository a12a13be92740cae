"""A thread at 20 Hz, which looks like 2 Hz at ten times the speed."""

import threading
import time

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
voice = node.create_publisher(String, "chatter", 10)


def talk():
    """Twenty times a second."""
    count = 0
    while rclpy.ok():
        voice.publish(String(data=f"Hello robotics {count}"))
        count += 1
        time.sleep(0.05)


threading.Thread(target=talk, daemon=True).start()
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    rclpy.try_shutdown()
