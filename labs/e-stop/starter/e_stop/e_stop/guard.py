"""The guard: stands between the operator and the motors, and stops the rover.

Do the TODOs in the order of their numbers. The names, the texts and the times
that you need stand on the card, in labs/e-stop/task.md.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile

# TODO 8: import the two message types that the card names, words of rclpy.qos,
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
        # TODO 10: give the node its name. Keep here what it knows: its three
        #          reasons to stop, which all hold at first, the last command, and
        #          the reason that was told last.
        super().__init__('change_me')
        # TODO 11: create the publisher, the two subscriptions, and a timer that
        #          calls self.tell_motors at the card's rate. Give each
        #          subscription the event that it needs, with the function below:
        #          event_callbacks=SubscriptionEventCallbacks(...)

    def hear_button(self, message):
        """Somebody pressed or released the stop."""
        # TODO 12: keep what the message says.

    def count_buttons(self, event):
        """A button came, or is gone."""
        # TODO 13: keep whether none is alive: event.alive_count says how many are.

    def hear_command(self, message):
        """The operator wants something."""
        # TODO 14: keep the command, and that commands come.

    def miss_command(self, event):
        """No command came within the deadline."""
        # TODO 15: keep that no commands come.

    def find_reason(self):
        """Say why the rover must stand still; nothing where it may drive."""
        # TODO 16: return the card's words for the first reason that holds, or None.

    def tell_motors(self):
        """Publish the command, or zero."""
        # TODO 17: publish the last command where there is no reason to stop, else
        #          an empty Twist: it is zero in all its fields.

    def tell_reason(self):
        """Write why the rover stops, when that is new."""
        # TODO 18: find the reason, and write it where it is another one than
        #          before. Call this function at the end of the four above.


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
