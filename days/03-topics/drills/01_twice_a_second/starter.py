"""A thermometer: a node called thermometer. It publishes the temperature on
/celsius, 2 times a second."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32


class Thermometer(Node):
    def __init__(self):
        super().__init__("thermometer")
        self.publisher = self.create_publisher(Float32, "celsius", 10)
        self.timer = self.create_timer(2, self.tell)

    def tell(self):
        self.publisher.publish(Float32(data=21.5))


def main():
    rclpy.init()
    rclpy.spin(Thermometer())


main()
