"""A beacon: a node called beacon. It beeps on /beep, as often as its parameter rate_hz
says. It is started with rate_hz 10.0."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Beacon(Node):
    def __init__(self):
        super().__init__("beacon")
        rate_hz = self.declare_parameter("rate_hz", 1.0).value
        self.publisher = self.create_publisher(Int32, "beep", 10)
        self.timer = self.create_timer(1.0 / rate_hz, self.beep)

    def beep(self):
        self.publisher.publish(Int32(data=1))


def main():
    rclpy.init()
    rclpy.spin(Beacon())


main()
