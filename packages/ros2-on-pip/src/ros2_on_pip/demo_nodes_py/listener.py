"""`ros2 run demo_nodes_py listener`: logs what it hears."""

import rclpy
from rclpy._rclpy_pybind11 import RCLError
from rclpy.exceptions import NotInitializedException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Listener(Node):
    """Subscribes to `chatter`."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.subscription = self.create_subscription(String, "chatter", self.hear, 10)

    def hear(self, message: String) -> None:
        """Log one text."""
        self.get_logger().info(f"I heard: [{message.data}]")


def main() -> None:
    """Run the node until Ctrl-C. What is wrong before that, a domain that is no number, is told.

    There is no try_shutdown(): rclpy's signal handler ends the context in a thread of its own. It
    may come between the two steps of that call, or while the executor works with the context.
    """
    try:
        rclpy.init()
        listen()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


def listen() -> None:
    """Listen until Ctrl-C, which may take the context away at any moment: that is no error."""
    try:
        rclpy.spin(Listener())
    except (NotInitializedException, RCLError):
        if rclpy.ok():
            raise


if __name__ == "__main__":
    main()
