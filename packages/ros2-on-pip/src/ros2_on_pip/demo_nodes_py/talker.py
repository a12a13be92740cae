"""`ros2 run demo_nodes_py talker`: says hello once a second, and counts."""

import rclpy
from rclpy._rclpy_pybind11 import RCLError
from rclpy.exceptions import NotInitializedException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    """Publishes a numbered text on `chatter`."""

    def __init__(self) -> None:
        super().__init__("talker")
        self.count = 0
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(1.0, self.say_hello)

    def say_hello(self) -> None:
        """Publish the next text, and log it."""
        message = String(data=f"Hello World: {self.count}")
        self.count += 1
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.publisher.publish(message)


def main() -> None:
    """Run the node until Ctrl-C. What is wrong before that, a domain that is no number, is told.

    There is no try_shutdown(): rclpy's signal handler ends the context in a thread of its own. It
    may come between the two steps of that call, or while the executor works with the context.
    """
    try:
        rclpy.init()
        talk()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


def talk() -> None:
    """Talk until Ctrl-C, which may take the context away at any moment: that is no error."""
    try:
        rclpy.spin(Talker())
    except (NotInitializedException, RCLError):
        if rclpy.ok():
            raise


if __name__ == "__main__":
    main()
