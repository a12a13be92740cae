"""A loop that sleeps on the wall clock, as many first programs do."""

import time

import rclpy
from geometry_msgs.msg import Twist

rclpy.init()
node = rclpy.create_node("follower")
publisher = node.create_publisher(Twist, "cmd_vel", 10)
command = Twist()
while rclpy.ok():
    rclpy.spin_once(node, timeout_sec=0.0)
    command.linear.x = 0.2
    publisher.publish(command)
    time.sleep(0.05)
