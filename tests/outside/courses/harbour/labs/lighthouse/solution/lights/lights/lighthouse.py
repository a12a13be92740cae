"""The lighthouse: it flashes so many times a second."""

import rclpy
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Empty


class Lighthouse(Node):
    """Publishes a message for each flash."""

    def __init__(self):
        super().__init__('lighthouse')
        few = IntegerRange(from_value=2, to_value=20, step=1)
        self.declare_parameter('flashes', 4, ParameterDescriptor(integer_range=[few]))
        self.declare_parameter('colour', 'white', ParameterDescriptor(read_only=True))
        self.publisher = self.create_publisher(Empty, 'flash', 10)
        self.timer = self.new_timer()
        self.add_post_set_parameters_callback(self.follow)

    def new_timer(self):
        """Make the timer that the parameter asks for."""
        return self.create_timer(1 / self.get_parameter('flashes').value, self.flash)

    def follow(self, parameters):
        """Act on what was set."""
        self.destroy_timer(self.timer)
        self.timer = self.new_timer()

    def flash(self):
        """Tell of one flash."""
        self.publisher.publish(Empty())


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Lighthouse())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
