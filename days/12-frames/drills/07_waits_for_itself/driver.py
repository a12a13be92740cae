"""A rover that drives: it tells on /tf where it is, 20 times a second."""

import rclpy
from geometry_msgs.msg import TransformStamped
from tf2_ros import TransformBroadcaster

rclpy.init()
node = rclpy.create_node("driver")
broadcaster = TransformBroadcaster(node)
step = TransformStamped(child_frame_id="base_link")
step.header.frame_id = "odom"


def tell():
    step.header.stamp = node.get_clock().now().to_msg()
    step.transform.translation.x += 0.01
    broadcaster.sendTransform(step)


node.create_timer(0.05, tell)
rclpy.spin(node)
