"""A loop that waits with create_rate, beside an executor in a thread."""

import threading

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
voice = node.create_publisher(String, "chatter", 10)
threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
rate = node.create_rate(2.0)
count = 0
try:
    while rclpy.ok():
        voice.publish(String(data=f"Hello robotics {count}"))
        count += 1
        rate.sleep()
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    rclpy.try_shutdown()
