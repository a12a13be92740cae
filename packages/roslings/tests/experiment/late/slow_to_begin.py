"""Its constructor takes a second and a half, and is done before it spins."""

import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    """Talks twice a second."""

    def __init__(self) -> None:
        super().__init__("talker")
        time.sleep(1.5)
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.create_timer(0.5, lambda: self.publisher.publish(String(data="hello")))


rclpy.init()
try:
    rclpy.spin(Talker())
finally:
    rclpy.try_shutdown()
