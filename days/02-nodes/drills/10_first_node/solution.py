"""Write a whole node, from the first line to the last.

It is called tick. On /ticks it says "tick 0", "tick 1", ... as std_msgs/msg/String,
10 times a second, and it logs each text with get_logger().info(...).
"""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Tick(Node):
    def __init__(self):
        super().__init__("tick")
        self.count = 0
        self.publisher = self.create_publisher(String, "ticks", 10)
        self.timer = self.create_timer(0.1, self.tell)

    def tell(self):
        message = String(data=f"tick {self.count}")
        self.publisher.publish(message)
        self.get_logger().info(message.data)
        self.count += 1


def main():
    rclpy.init()
    rclpy.spin(Tick())


main()
