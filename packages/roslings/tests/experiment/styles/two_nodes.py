"""The talker and a quiet companion in one process and one executor."""

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    """Says hello twice a second."""

    def __init__(self):
        super().__init__("talker")
        self.voice = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(0.5, self.talk)
        self.count = 0

    def talk(self):
        """One more."""
        self.voice.publish(String(data=f"Hello robotics {self.count}"))
        self.count += 1


try:
    rclpy.init()
    executor = SingleThreadedExecutor()
    for node in (Talker(), Node("companion")):
        executor.add_node(node)
    executor.spin()
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    rclpy.try_shutdown()
