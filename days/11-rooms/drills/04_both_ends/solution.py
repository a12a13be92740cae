"""A gatekeeper: a node called gatekeeper. For each scan on /scan it looks at a cone
ahead, from 45 degrees on the right to 45 degrees on the left. It prints "blocked"
where something in it is nearer than 0.5 m, else "free". This laser has eight beams.

The drill runs the laser, too. By hand, start it in another terminal: python3 gate.py
"""

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class Gatekeeper(Node):
    def __init__(self):
        super().__init__("gatekeeper")
        self.create_subscription(LaserScan, "scan", self.look, qos_profile_sensor_data)

    def look(self, scan):
        ahead = min(*scan.ranges[-1:], *scan.ranges[:2])
        print("blocked" if ahead < 0.5 else "free")


def main():
    rclpy.init()
    rclpy.spin(Gatekeeper())


main()
