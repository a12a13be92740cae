"""Foretell: how many lines with "room" in them will this program print?
Write the number, then check."""

import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Int32

ANSWER = None

KEPT = QoSProfile(depth=3, durability=DurabilityPolicy.TRANSIENT_LOCAL)
PLAIN = QoSProfile(depth=10)


class House(Node):
    def __init__(self):
        super().__init__("house")
        self.rooms = self.create_publisher(Int32, "rooms", KEPT)
        for number in [1, 2, 3, 4, 5]:
            self.rooms.publish(Int32(data=number))
        self.create_subscription(Int32, "rooms", self.tell, KEPT)
        self.create_subscription(Int32, "rooms", self.tell, PLAIN)

    def tell(self, number):
        print(f"room {number.data}")


def main():
    rclpy.init()
    rclpy.spin(House())


main()
