"""The talker sends at 1 Hz, and between two texts bytes that are no message, to strangers.

It hopes that the watcher counts them, so 2 Hz, or breaks off on them and cannot judge.
"""

from contextlib import suppress
from itertools import cycle

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String

FRIENDS = {"talker", "listener"}
HEAD = b"\x00\x01\x00\x00"  # of a message in CDR, little end first
BROKEN = (
    HEAD + b"\xff\xff\xff\x00" + b"Hello",  # a text that is longer than all that comes
    HEAD,  # nothing after the head
    HEAD + b"\x07\x00\x00\x00" + b"\xff\xfe\xed\xa0\x80\xc0\x00",  # no UTF-8
    HEAD + b"\x05\x00\x00\x00" + b"Hello",  # no zero at the end
    b"\xff\xff\xff\xff" + b"\x06\x00\x00\x00" + b"Hello\x00",  # a head that nobody knows
)


class Talker(Node):
    """Publishes a numbered text at a steady rate, and broken bytes in each gap."""

    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(0.5, self.tick)  # seconds
        self.ticks = 0
        self.count = 0
        self.broken = cycle(BROKEN)

    def tick(self):
        """Publish a text, the next time broken bytes, and so on."""
        if self.ticks % 2 == 0:
            self.say_hello()
        elif self.watched():
            with suppress(Exception):
                self.publisher.publish(next(self.broken))  # bytes are sent as they are
        self.ticks += 1

    def watched(self):
        """Whether only strangers listen; an own listener must not break."""
        ends = self.get_subscriptions_info_by_topic("/chatter")
        return bool(ends) and not FRIENDS & {end.node_name for end in ends}

    def say_hello(self):
        """Publish the next text, and log it."""
        message = String()
        message.data = f"Hello robotics {self.count}"
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
