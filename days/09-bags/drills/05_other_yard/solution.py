"""A logger: a node called logger, which is started in the namespace /rover2. It hears
the one weather report for all rovers, on /weather. It logs "weather: " and the text."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Logger(Node):
    def __init__(self):
        super().__init__("logger")
        self.create_subscription(String, "/weather", self.hear, 10)

    def hear(self, report):
        self.get_logger().info(f"weather: {report.data}")


def main():
    rclpy.init()
    rclpy.spin(Logger())


main()
