"""A thread of its own that sleeps until the next half second."""

import threading
import time

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
voice = node.create_publisher(String, "chatter", 10)


def talk():
    """Twice a second, by the clock on the wall."""
    count, due_s = 0, time.monotonic()
    while rclpy.ok():
        voice.publish(String(data=f"Hello robotics {count}"))
        count += 1
        due_s += 0.5
        time.sleep(max(0.0, due_s - time.monotonic()))


threading.Thread(target=talk, daemon=True).start()
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    rclpy.try_shutdown()
