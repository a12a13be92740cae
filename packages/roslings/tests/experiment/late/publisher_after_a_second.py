"""A timer makes its publisher, a second after it begins."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    """Talks twice a second, but not at once."""

    def __init__(self) -> None:
        super().__init__("talker")
        self.begin_timer = self.create_timer(1.0, self.begin)

    def begin(self) -> None:
        """Once."""
        self.begin_timer.cancel()
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.create_timer(0.5, lambda: self.publisher.publish(String(data="hello")))


rclpy.init()
try:
    rclpy.spin(Talker())
finally:
    rclpy.try_shutdown()
