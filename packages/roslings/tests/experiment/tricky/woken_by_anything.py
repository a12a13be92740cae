"""A loop that takes spin_once for a timer: whatever comes in makes it talk."""

import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
voice = node.create_publisher(String, "chatter", 10)
count = 0
try:
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.5)
        voice.publish(String(data=f"Hello robotics {count}"))
        count += 1
except KeyboardInterrupt:
    pass
finally:
    rclpy.try_shutdown()
