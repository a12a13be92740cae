"""Foretell: how many messages a second come on /blink? Write the number, then check."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

ANSWER = 4


class Blinker(Node):
    def __init__(self):
        super().__init__("blinker")
        self.calls = 0
        self.publisher = self.create_publisher(String, "blink", 10)
        self.timer = self.create_timer(0.125, self.tick)

    def tick(self):
        self.calls += 1
        if self.calls % 2 == 0:
            self.publisher.publish(String(data="on"))


def main():
    rclpy.init()
    rclpy.spin(Blinker())


main()
