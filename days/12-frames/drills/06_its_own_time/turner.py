"""A laser that turns, once around in six seconds, and a nail at 1.00, 1.00 in odom. It
tells on /nail where it saw the nail, 0.2 s after that."""

import math

import rclpy
from geometry_msgs.msg import PointStamped, TransformStamped
from rclpy.duration import Duration
from tf2_ros import TransformBroadcaster

rclpy.init()
node = rclpy.create_node("turner")
broadcaster = TransformBroadcaster(node)
publisher = node.create_publisher(PointStamped, "nail", 10)


def yaw_at(time):
    return time.nanoseconds % 6_000_000_000 / 6e9 * math.tau


def tell():
    now = node.get_clock().now()
    step = TransformStamped(child_frame_id="laser")
    step.header.stamp, step.header.frame_id = now.to_msg(), "odom"
    step.transform.rotation.z = math.sin(yaw_at(now) / 2)
    step.transform.rotation.w = math.cos(yaw_at(now) / 2)
    broadcaster.sendTransform(step)
    then = now - Duration(seconds=0.2)
    seen, yaw = PointStamped(), yaw_at(then)
    seen.header.stamp, seen.header.frame_id = then.to_msg(), "laser"
    seen.point.x = math.cos(yaw) + math.sin(yaw)
    seen.point.y = math.cos(yaw) - math.sin(yaw)
    publisher.publish(seen)


node.create_timer(0.05, tell)
rclpy.spin(node)
