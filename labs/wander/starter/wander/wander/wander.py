"""A rover that follows a wall in any room, and lets pass what moves.

Do the TODOs in the order of their numbers. The names and numbers that you need
stand on the card, in labs/wander/task.md.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

# TODO 3: import math, the two message types of the card, and the QoS profile for
#         sensors from rclpy.qos.


def by_degrees(scan):
    """Give the distance in each whole degree, 0 ahead and 90 to the left."""
    # TODO 4: the angle of a distance is angle_min + number * angle_increment. Make a
    #         dictionary: whole degrees from -180 to 179, and the distance in each.
    #         inf is nothing at all, -inf is too near, and NaN says nothing.
    return {}


def steer(seen, side):
    """Return forward in m/s and turn in rad/s; side is 'left' or 'right'."""
    # TODO 5: where on that side is the wall nearest, and how far is it? Ahead of the
    #         wall's place is 90 degrees less. Turn so that you drive along it: more
    #         towards the wall where it is too far, away from it where it is too near.
    #         A turn to the left is positive. Is there no wall? Then drive straight on.
    # TODO 6: the nearer something is ahead, the slower you drive. Where it is so near
    #         that you must stop, turn on the spot, away from the wall.
    return 0.0, 0.0


class Wander(Node):
    """Answers each scan with a command."""

    def __init__(self):
        # TODO 7: the name of the card, its parameter, a publisher of commands, and a
        #         subscription to the scans that calls self.look.
        super().__init__('change_me')

    def look(self, scan):
        """Say what to do now."""
        # TODO 8: publish a command for each scan.
        # TODO 9: something moves into the way: stand, until it is gone. A wall stays
        #         where it is while you stand; what moves does not. Count time by
        #         scan.header.stamp.


def main(args=None):
    """Run the node until Ctrl-C."""
    # This part is complete.
    try:
        rclpy.init(args=args)
        rclpy.spin(Wander())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
