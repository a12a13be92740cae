"""A reader: a node called reader. Each text that comes on /news (std_msgs/msg/String)
it logs like this: I read: TEXT"""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Reader(Node):
    def __init__(self):
        super().__init__("reader")
        self.create_subscription(String, "new", self.read, 10)

    def read(self, message):
        self.get_logger().info(f"I read: {message.data}")


def main():
    rclpy.init()
    rclpy.spin(Reader())


main()
