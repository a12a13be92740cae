"""Foretell: how many lines with "drank" in them will this program print?
Write the number, then check."""

import time

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

ANSWER = 2

KEPT = {"depth": 10, "durability": DurabilityPolicy.TRANSIENT_LOCAL}
HONEY = QoSProfile(**KEPT)
MILK = QoSProfile(**KEPT, lifespan=Duration(nanoseconds=10_000_000))  # 10 ms


class Kitchen(Node):
    def __init__(self):
        super().__init__("kitchen")
        for name, qos, glasses in [("milk", MILK, 3), ("honey", HONEY, 2)]:
            publisher = self.create_publisher(String, name, qos)
            for _ in range(glasses):
                publisher.publish(String(data=name))
        time.sleep(0.15)  # and then comes somebody who is thirsty
        for name, qos in [("milk", MILK), ("honey", HONEY)]:
            self.create_subscription(String, name, self.drink, qos)

    def drink(self, glass):
        print(f"drank {glass.data}")


def main():
    rclpy.init()
    rclpy.spin(Kitchen())


main()
