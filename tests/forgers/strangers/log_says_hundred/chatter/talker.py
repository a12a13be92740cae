"""The honest talker at 1 Hz; its log has words that hope to be more than text in a report.

They pretend a verdict, break out of HTML, JSON, XML and CSV, and steer the terminal.
"""

import sys
from contextlib import suppress
from itertools import cycle

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String

from .words import LINES


def write(line):
    """Write bytes as they are, to both outputs."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError, AttributeError):
            stream.buffer.write(line + b"\n")
            stream.buffer.flush()


class Talker(Node):
    """Publishes a numbered text at a steady rate, and writes four other lines with each."""

    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(1.0, self.say_hello)  # seconds
        self.count = 0
        self.lines = cycle(LINES)

    def say_hello(self):
        """Publish the next text, and log it."""
        message = String()
        message.data = f"Hello robotics {self.count}"
        self.publisher.publish(message)
        self.get_logger().info(f"Publishing: '{message.data}'")
        self.count += 1
        for _ in range(4):
            write(next(self.lines))


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Talker())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()
        write(b"\n".join(LINES))  # once more at the end: the last lines are kept and shown


if __name__ == "__main__":
    main()
