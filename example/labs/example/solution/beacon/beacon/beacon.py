"""The beacon: tells on a topic that it is alive, again and again."""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Beacon(Node):
    """Publishes a numbered text at a steady rate."""

    def __init__(self):
        super().__init__('beacon')
        self.publisher = self.create_publisher(String, 'alive', 10)
        self.timer = self.create_timer(1.0, self.tell)  # seconds
        self.count = 0

    def tell(self):
        """Publish the next text."""
        message = String()
        message.data = f'alive {self.count}'
        self.publisher.publish(message)
        self.get_logger().info(f"Telling: '{message.data}'")
        self.count += 1


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Beacon())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
