"""A node that says hello on /greetings once a second."""

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String


def main() -> None:
    """Run the node until Ctrl-C."""
    rclpy.init()
    node = rclpy.create_node("hello")
    publisher = node.create_publisher(String, "greetings", 10)

    def greet() -> None:
        message = String(data="Hello")
        publisher.publish(message)
        node.get_logger().info(f"I say: {message.data}")

    node.create_timer(1.0, greet)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        rclpy.try_shutdown()
