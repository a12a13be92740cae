"""A pilot: a node called pilot. Ten times a second it tells the robot on /cmd_vel to go
0.2 metres a second, and to turn left by 45 degrees a second."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node

TURN_DEG_S = 45.0


class Pilot(Node):
    def __init__(self):
        super().__init__("pilot")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.timer = self.create_timer(0.1, self.steer)

    def steer(self):
        order = Twist()
        order.linear.x = 0.2
        order.angular.z = math.radians(TURN_DEG_S)
        self.publisher.publish(order)


def main():
    rclpy.init()
    rclpy.spin(Pilot())


main()
