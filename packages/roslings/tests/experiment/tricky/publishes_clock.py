"""It makes its own time."""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String


class Talker(Node):
    """Not quite a talker."""

    def __init__(self):
        super().__init__("talker")
        self.voice = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(0.5, self.talk)
        self.time = self.create_publisher(Clock, "clock", 10)
        self.count = 0

    def talk(self):
        """One turn."""
        self.voice.publish(String(data=f"Hello robotics {self.count}"))
        self.count += 1
        self.time.publish(Clock())


try:
    rclpy.init()
    rclpy.spin(Talker())
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    rclpy.try_shutdown()
