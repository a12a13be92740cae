"""The battery: a node called battery. It says "charge 0", "charge 1", ...
on /charge, 4 times a second."""

import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Battery(Node):
    def __init__(self):
        super().__init__("battery")
        self.count = 0
        self.publisher = self.create_publisher(String, "charge", 10)
        self.timer = self.create_timer(0.25, self.tell)

    def tell(self):
        self.publisher.publish(String(data=f"charge {self.count}"))
        self.count += 1


def main():
    rclpy.init()
    battery = Battery()
    while battery.count < 1000:
        time.sleep(0.25)


main()
