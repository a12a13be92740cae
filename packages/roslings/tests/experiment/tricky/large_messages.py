"""Messages of 10 MB, twice a second."""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    """Not quite a talker."""

    def __init__(self):
        super().__init__("talker")
        self.voice = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(0.5, self.talk)
        self.count = 0

    def talk(self):
        """One turn."""
        self.voice.publish(String(data="x" * 10_000_000))


try:
    rclpy.init()
    rclpy.spin(Talker())
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    rclpy.try_shutdown()
