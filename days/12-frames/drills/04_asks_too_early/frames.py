"""The frames of this drill: a laser sits on a rover, 0.20 m ahead of its middle."""

import rclpy
from geometry_msgs.msg import TransformStamped
from tf2_ros import StaticTransformBroadcaster

rclpy.init()
node = rclpy.create_node("frames")
broadcaster = StaticTransformBroadcaster(node)
mount = TransformStamped(child_frame_id="laser")
mount.header.frame_id = "base_link"
mount.transform.translation.x = 0.20
broadcaster.sendTransform(mount)
rclpy.spin(node)
