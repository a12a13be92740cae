"""A stopper: a node called stopper. It hears on /ahead how far the way is free, as
sensor_msgs/msg/Range. For each message it publishes a command on /cmd_vel: forward with
0.2 metres a second, or 0.0 where the way is free for less than 0.5 m."""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from sensor_msgs.msg import Range


class Stopper(Node):
    def __init__(self):
        super().__init__("stopper")
        self.free_m = 0.0  # nothing is known yet: stand
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Range, "ahead", self.look, 10)

    def look(self, ahead):
        self.free_m = ahead.range
        self.steer()

    def steer(self):
        command = Twist()
        command.linear.x = 0.2 if self.free_m >= 0.5 else 0.0
        self.publisher.publish(command)


def main():
    rclpy.init()
    rclpy.spin(Stopper())


main()
