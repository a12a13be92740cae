"""A thread at 1 Hz: no timer of it speaks, and robot time goes by in silence."""

import threading
import time

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
voice = node.create_publisher(String, "chatter", 10)


def talk():
    """Once a second, the first time after a second."""
    count = 0
    while rclpy.ok():
        time.sleep(1.0)
        voice.publish(String(data=f"Hello robotics {count}"))
        count += 1


threading.Thread(target=talk, daemon=True).start()
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    rclpy.try_shutdown()
