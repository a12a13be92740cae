"""A loop whose only wait is spin_once: whatever comes in wakes it."""

import time

import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
voice = node.create_publisher(String, "chatter", 10)
count, due_s = 0, time.monotonic()
try:
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=max(0.0, due_s - time.monotonic()))
        if time.monotonic() >= due_s:
            voice.publish(String(data=f"Hello robotics {count}"))
            count += 1
            due_s += 0.5
except KeyboardInterrupt:
    pass
finally:
    rclpy.try_shutdown()
