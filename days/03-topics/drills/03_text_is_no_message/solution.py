"""A greeter: a node called greeter. It says "good day 0", "good day 1", ...
on /greeting, 4 times a second."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Greeter(Node):
    def __init__(self):
        super().__init__("greeter")
        self.count = 0
        self.publisher = self.create_publisher(String, "greeting", 10)
        self.timer = self.create_timer(0.25, self.greet)

    def greet(self):
        self.publisher.publish(String(data=f"good day {self.count}"))
        self.count += 1


def main():
    rclpy.init()
    rclpy.spin(Greeter())


main()
