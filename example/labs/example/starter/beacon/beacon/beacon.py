"""The beacon: tells on a topic that it is alive, again and again.

Do the TODOs in the order of their numbers. The names, the text and the rate
that you need stand on the card, in task.md.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

# TODO 3: import the message type that the card names, from its package.


class Beacon(Node):
    """Publishes a numbered text at a steady rate."""

    def __init__(self):
        # TODO 4: give the node the name from the card.
        super().__init__('change_me')
        # TODO 5: create a publisher and a timer. Keep both.
        # TODO 6: create the counter, self.count. It starts at zero.

    def tell(self):
        """Publish the next text."""
        # TODO 7: publish a message with the text and the number, then count.


def main(args=None):
    """Run the node until Ctrl-C."""
    # This part is complete.
    try:
        rclpy.init(args=args)
        rclpy.spin(Beacon())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
