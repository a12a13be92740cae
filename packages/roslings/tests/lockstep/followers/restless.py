"""Never waits: its loop asks for work again and again."""

import rclpy

rclpy.init()
node = rclpy.create_node("follower")
while rclpy.ok():
    rclpy.spin_once(node, timeout_sec=0.0)
