"""A log of a barometer: a node called barometer_log. It listens on /pressure. The
barometer offers what a plain 10 means: reliable and volatile."""

import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float32

EVERYTHING = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class BarometerLog(Node):
    def __init__(self):
        super().__init__("barometer_log")
        self.create_subscription(Float32, "pressure", self.hear, EVERYTHING)

    def hear(self, pressure):
        print(f"{pressure.data:.1f} hPa")


def main():
    rclpy.init()
    rclpy.spin(BarometerLog())


main()
