"""No class: a node, a timer and a function that remembers."""

import itertools

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String


def main():
    """Run until Ctrl-C."""
    rclpy.init()
    node = rclpy.create_node("talker")
    voice = node.create_publisher(String, "chatter", 10)
    numbers = itertools.count()
    node.create_timer(0.5, lambda: voice.publish(String(data=f"Hello robotics {next(numbers)}")))
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


main()
