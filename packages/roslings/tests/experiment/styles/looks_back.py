"""In its first callback it reckons with a time before: that needs a clock as a computer has it."""

import rclpy
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    """A node that tells what time it was a minute ago."""

    def __init__(self):
        super().__init__("talker")
        self.since = Duration(seconds=60)
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(0.5, self.say)

    def say(self):
        """Say what time it was."""
        now = self.get_clock().now()
        self.publisher.publish(String(data=f"{(now - self.since).nanoseconds}"))


def main():
    """Run it until Ctrl-C."""
    try:
        rclpy.init()
        rclpy.spin(Talker())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


main()
