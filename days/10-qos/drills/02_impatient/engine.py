"""The engine of this drill: it tells its temperature, at least once a second."""

import rclpy
from rclpy.duration import Duration
from rclpy.qos import QoSProfile
from std_msgs.msg import Int32

rclpy.init()
node = rclpy.create_node("engine")
promised = QoSProfile(depth=10, deadline=Duration(seconds=1.0))
publisher = node.create_publisher(Int32, "engine", promised)
node.create_timer(0.1, lambda: publisher.publish(Int32(data=80)))
rclpy.spin(node)
