"""The beacon: says again and again which rover this is.

Do the TODOs in the order of their numbers. The names and the numbers that you need
stand on the card, in labs/bring-up/task.md.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String

# TODO 8: import IntegerRange and ParameterDescriptor from rcl_interfaces.msg.


class Beacon(Node):
    """Publishes the rover's name, so many times a second."""

    def __init__(self):
        # TODO 9: give the node and its topic the names from the card. Declare the
        #         two parameters: one that nobody can change while the node runs,
        #         and one that has a range.
        super().__init__('change_me')
        self.publisher = self.create_publisher(String, 'change_me', 10)
        self.timer = self.new_timer()
        # TODO 11: let ROS call self.follow after it has set parameters, and write
        #         that function.

    def new_timer(self):
        """Make the timer that the parameter asks for."""
        # TODO 10: read the rate, and in tell() the name, from the parameters.
        rate = 5  # messages a second
        return self.create_timer(1 / rate, self.tell)

    def follow(self, parameters):
        """Act on parameters that were set; what is refused never comes here."""
        # Where the rate is among them: destroy the timer, and make a new one.

    def tell(self):
        """Publish the name."""
        self.publisher.publish(String(data='rover'))


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
