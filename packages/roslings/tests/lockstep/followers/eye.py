"""The first of a chain: /scan in, the nearest distance ahead out."""

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float32


class Eye(Node):
    """Says one number for each scan."""

    def __init__(self) -> None:
        super().__init__("eye")
        self.publisher = self.create_publisher(Float32, "nearest", 10)
        self.create_subscription(LaserScan, "scan", self.hear, qos_profile_sensor_data)

    def hear(self, scan: LaserScan) -> None:
        """The nearest of 60 beams."""
        ahead = [*scan.ranges[:30], *scan.ranges[-30:]]
        self.publisher.publish(Float32(data=min(6.0, *ahead)))


rclpy.init()
rclpy.spin(Eye())
