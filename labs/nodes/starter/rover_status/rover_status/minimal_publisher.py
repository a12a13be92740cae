"""The minimal publisher: tells on a topic that the rover is there, and counts.

Do the TODOs in the order of their numbers. The names, the text and the rate
that you need stand on the card, in labs/nodes/task.md.
"""

import rclpy
from rclpy.node import Node

# TODO 3: import the message type that the card names, from its package.


class MinimalPublisher(Node):
    """Publishes a numbered status; how often is a parameter."""

    def __init__(self):
        # TODO 4: give the node the name from the card, without the slash.
        super().__init__('change_me')
        # TODO 5: create a publisher: message type, topic, queue length 10.
        #         Write the topic without a slash. Keep it as self.publisher.
        # TODO 6: create a timer that calls self.tell_status. It wants a period
        #         in seconds; the card gives a rate in Hz. Keep the timer too.
        # TODO 7: create the counter, self.count. It starts at zero.
        # TODO 11: when all else works, declare the parameter of the card and
        #          read it. Give its value to the timer, in place of the number.

    def tell_status(self):
        """Publish the next status, and log it."""
        # TODO 8: make a message and put the text with the number into its
        #         field "data". Publish the message.
        # TODO 9: log the line that the card asks for.
        # TODO 10: add one to the counter.


def main(args=None):
    """Run the node until Ctrl-C."""
    rclpy.init(args=args)
    rclpy.spin(MinimalPublisher())
    rclpy.shutdown()
    # TODO 12: run the node, press Ctrl-C and read what it writes. Then put
    #          the three lines above into try, except and finally, so that
    #          the node ends without an error. Two exceptions come at Ctrl-C:
    #          KeyboardInterrupt and rclpy.executors.ExternalShutdownException.
    #          In finally, call rclpy.try_shutdown() in place of the last line.


if __name__ == '__main__':
    main()
