"""A turner: a node called turner. For each scan on /scan it publishes a command on
/cmd_vel, which turns the rover to what is nearest: by 0.5 radians a second, to the left
or to the right. Here the nearest thing stands on the left.

The drill runs the laser, too. By hand, start it in another terminal: python3 laser.py
"""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class Turner(Node):
    def __init__(self):
        super().__init__("turner")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(LaserScan, "scan", self.look, qos_profile_sensor_data)

    def look(self, scan):
        index = scan.ranges.index(min(scan.ranges))
        angle = math.remainder(scan.angle_min + index * scan.angle_increment, math.tau)
        command = Twist()
        command.angular.z = -0.5 if angle > 0 else 0.5
        self.publisher.publish(command)


def main():
    rclpy.init()
    rclpy.spin(Turner())


main()
