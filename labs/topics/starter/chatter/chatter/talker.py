"""The talker: says hello on a topic, again and again, and counts.

Do the TODOs in the order of their numbers. The names, the text and the rate
that you need stand on the card, in labs/topics/task.md.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

# TODO 3: import the message type that the card names, from its package.


class Talker(Node):
    """Publishes a numbered text at a steady rate."""

    def __init__(self):
        # TODO 4: give the node the name from the card.
        super().__init__('change_me')
        # TODO 5: create a publisher: message type, topic, queue length 10.
        #         Keep it as self.publisher.
        # TODO 6: create a timer that calls self.say_hello. It wants a period
        #         in seconds; the card gives a rate in Hz. Keep the timer too.
        # TODO 7: create the counter, self.count. It starts at zero.

    def say_hello(self):
        """Publish the next text, and log it."""
        # TODO 8: make a message and put the text with the number into its
        #         field "data". Publish the message.
        # TODO 9: log the line that the card asks for.
        # TODO 10: add one to the counter.


def main(args=None):
    """Run the node until Ctrl-C."""
    # This part is complete. You need it again in listener.py.
    try:
        rclpy.init(args=args)
        rclpy.spin(Talker())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
