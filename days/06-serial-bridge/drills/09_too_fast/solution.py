"""A motor: a node called motor. For each order on /cmd_vel it publishes a number on
/pwm: 500 for each metre a second, but never beyond -255 and 255."""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Int32


class Motor(Node):
    def __init__(self):
        super().__init__("motor")
        self.publisher = self.create_publisher(Int32, "pwm", 10)
        self.create_subscription(Twist, "cmd_vel", self.drive, 10)

    def drive(self, order):
        pwm = max(-255, min(255, round(order.linear.x * 500)))
        self.publisher.publish(Int32(data=pwm))


def main():
    rclpy.init()
    rclpy.spin(Motor())


main()
