"""A loop of publish, spin_once without waiting, and sleep."""

import time

import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
voice = node.create_publisher(String, "chatter", 10)
count = 0
try:
    while rclpy.ok():
        voice.publish(String(data=f"Hello robotics {count}"))
        count += 1
        rclpy.spin_once(node, timeout_sec=0.0)
        time.sleep(0.499)
except KeyboardInterrupt:
    pass
finally:
    rclpy.try_shutdown()
