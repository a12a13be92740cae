"""A speedometer: a node called speedometer. It publishes the speed on /speed as
std_msgs/msg/Float32, 5 times a second. The display listens, and stays dark."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64


class Speedometer(Node):
    def __init__(self):
        super().__init__("speedometer")
        self.publisher = self.create_publisher(Float64, "speed", 10)
        self.timer = self.create_timer(0.2, self.tell)

    def tell(self):
        self.publisher.publish(Float64(data=0.4))


def main():
    rclpy.init()
    rclpy.spin(Speedometer())


main()
