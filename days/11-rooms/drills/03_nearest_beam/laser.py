"""The laser of this drill: eight beams, the first ahead, the next to its left."""

import math

import rclpy
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

rclpy.init()
node = rclpy.create_node("laser")
publisher = node.create_publisher(LaserScan, "scan", qos_profile_sensor_data)
scan = LaserScan(angle_increment=math.pi / 4, range_min=0.1, range_max=6.0)
scan.ranges = [2.0, 2.0, 0.5, 2.0, 2.0, 2.0, 2.0, 2.0]
node.create_timer(0.1, lambda: publisher.publish(scan))
rclpy.spin(node)
