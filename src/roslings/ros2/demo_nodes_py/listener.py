"""`ros2 run demo_nodes_py listener`: logs what it hears."""

import rclpy
from rclpy._rclpy_pybind11 import RCLError
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Listener(Node):
    """Subscribes to `chatter`."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.ear = self.create_subscription(String, "chatter", self.hear, 10)

    def hear(self, message: String) -> None:
        """Log one text."""
        self.get_logger().info(f"I heard: [{message.data}]")


def main() -> None:
    """Run the node until Ctrl-C.

    No try_shutdown(): rclpy's signal handler ends the context in a thread of its own, and may come
    between the two steps of that call, or while the executor works with the context.
    """
    try:
        rclpy.init()
        rclpy.spin(Listener())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except RCLError:
        if rclpy.ok():
            raise


if __name__ == "__main__":
    main()
