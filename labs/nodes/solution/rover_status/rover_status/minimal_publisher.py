"""The minimal publisher: tells on a topic that the rover is there, and counts."""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class MinimalPublisher(Node):
    """Publishes a numbered status; how often is a parameter."""

    def __init__(self):
        super().__init__('minimal_publisher')
        self.declare_parameter('period', 1.0)  # seconds
        period = self.get_parameter('period').value
        self.publisher = self.create_publisher(String, 'robot_status', 10)
        self.timer = self.create_timer(period, self.tell_status)
        self.count = 0

    def tell_status(self):
        """Publish the next status, and log it."""
        status = String()
        status.data = f'Robot status count: {self.count}'
        self.publisher.publish(status)
        self.get_logger().info(f"Publishing: '{status.data}'")
        self.count += 1


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(MinimalPublisher())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
