"""A lookout: a node called lookout. For each scan on /scan it prints in which direction
the nearest thing is, in degrees: "nearest at 90 degrees". This laser has eight beams.

The drill runs the laser, too. By hand, start it in another terminal: python3 laser.py
"""

import math

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class Lookout(Node):
    def __init__(self):
        super().__init__("lookout")
        self.create_subscription(LaserScan, "scan", self.look, qos_profile_sensor_data)

    def look(self, scan):
        index = min(range(len(scan.ranges)), key=lambda each: scan.ranges[each])
        angle = scan.angle_min + index * scan.angle_increment
        print(f"nearest at {math.degrees(angle):.0f} degrees")


def main():
    rclpy.init()
    rclpy.spin(Lookout())


main()
