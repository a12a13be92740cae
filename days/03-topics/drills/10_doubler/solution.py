"""Write a whole node, from the first line to the last.

It is called doubler. It hears numbers on /number, and publishes each one times two
on /doubled. Both topics carry std_msgs/msg/Float64.
"""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64


class Doubler(Node):
    def __init__(self):
        super().__init__("doubler")
        self.publisher = self.create_publisher(Float64, "doubled", 10)
        self.create_subscription(Float64, "number", self.hear, 10)

    def hear(self, message):
        self.publisher.publish(Float64(data=message.data * 2))


def main():
    rclpy.init()
    rclpy.spin(Doubler())


main()
