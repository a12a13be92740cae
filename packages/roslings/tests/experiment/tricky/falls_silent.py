"""Six messages, and then none: the node runs on."""

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
        self.voice.publish(String(data=f"Hello robotics {self.count}"))
        self.count += 1
        if self.count == 6:
            self.timer.cancel()


try:
    rclpy.init()
    rclpy.spin(Talker())
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    rclpy.try_shutdown()
