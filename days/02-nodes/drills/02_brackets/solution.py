"""The rover's heart: a node called heart. It says "beat 0", "beat 1", ...
on /heartbeat, 5 times a second."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Heart(Node):
    def __init__(self):
        super().__init__("heart")
        self.count = 0
        self.publisher = self.create_publisher(String, "heartbeat", 10)
        self.timer = self.create_timer(0.2, self.beat)

    def beat(self):
        self.publisher.publish(String(data=f"beat {self.count}"))
        self.count += 1


def main():
    rclpy.init()
    rclpy.spin(Heart())


main()
