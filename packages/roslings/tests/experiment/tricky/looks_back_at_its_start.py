"""At its start it reckons with a time before: in simulated time its clock still shows 0 then."""

import rclpy
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    """A node that counts the seconds since it last spoke."""

    def __init__(self):
        super().__init__("talker")
        self.spoke = self.get_clock().now() - Duration(seconds=1)
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(0.5, self.say)

    def say(self):
        """Say how long ago it last spoke."""
        now = self.get_clock().now()
        self.publisher.publish(String(data=f"{(now - self.spoke).nanoseconds}"))
        self.spoke = now


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
