"""The guard: stands between the operator and the motors, and stops the rover.

Do the TODOs in the order of their numbers. The names, the texts and the times
that you need stand on the card, in labs/e-stop/task.md.
"""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile

# TODO 8: import what else you need: the other message type, words of rclpy.qos,
#         Duration of rclpy.duration, and SubscriptionEventCallbacks of
#         rclpy.event_handler.

# TODO 9: write the three profiles: for the button, for the commands that come,
#         and for the commands that go on to the motors.
BUTTON = QoSProfile(depth=10)
COMMANDS = QoSProfile(depth=10)
MOTORS = QoSProfile(depth=10)


class Guard(Node):
    """Passes commands on, as long as there is no reason to stop."""

    def __init__(self):
        # TODO 10: give the node its name. Keep here what the node knows: the
        #          three reasons to stop, all of which hold at first, and the
        #          last command.
        super().__init__('change_me')
        # TODO 11: create the publisher, the two subscriptions without events,
        #          and a timer that calls self.tell_motors at the card's rate.
        # TODO 13: give each subscription its event, and that event its
        #          function: event_callbacks=SubscriptionEventCallbacks(...)

    def tell_motors(self):
        """Publish the command, or zero."""
        # TODO 12: publish the last command where no reason to stop holds, else
        #          an empty Twist: it is zero in all its fields.

    # TODO 14: write a function for each of the two topics and of the two events.
    #          Each keeps what is true now: whether the stop is pressed, whether
    #          a button is alive, and whether commands come.

    # TODO 15: write the reason to the log, when it is a new one.


def main(args=None):
    """Run the guard until Ctrl-C."""
    # This part is complete.
    try:
        rclpy.init(args=args)
        rclpy.spin(Guard())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
