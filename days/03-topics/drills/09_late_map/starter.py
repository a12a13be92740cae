"""A map maker: a node called map_maker. Once, at its start, it says "cellar 1" on
/map_name. Those who come later must hear it, too (they ask for TRANSIENT_LOCAL)."""

import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String


class MapMaker(Node):
    def __init__(self):
        super().__init__("map_maker")
        self.publisher = self.create_publisher(String, "map_name", 10)
        self.publisher.publish(String(data="cellar 1"))


def main():
    rclpy.init()
    rclpy.spin(MapMaker())


main()
