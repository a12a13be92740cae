"""The distance sensor: turns the time of a sonar's echo into a distance.

Do the TODOs in the order of their numbers. The names and numbers that you need
stand on the card, in labs/distance-sensor/task.md.
"""

import math

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

# TODO 3: import the two message types that this node needs: the one that it
#         hears and the one that it publishes.


class DistanceSensor(Node):
    """Hears how long each echo took, and publishes the distance at a steady rate."""

    def __init__(self):
        # TODO 4: give the node the name from the card, without the slash.
        super().__init__('change_me')
        self.distance = math.nan  # nothing is known before the first echo
        # TODO 5: create a subscription to the echo: type, topic,
        #         self.hear_echo, queue length 10.
        # TODO 6: create a publisher for the distance (queue length 10), and a
        #         timer that calls self.tell_distance at the card's rate.

    def hear_echo(self, echo):
        """Keep the distance that belongs to an echo's time, in seconds."""
        # TODO 7: compute the distance in metres from echo.data, and keep it as
        #         self.distance. The sound went there and back.

    def tell_distance(self):
        """Publish the distance; what is out of range is infinite (REP 117)."""
        # TODO 8: make a message, and fill the fields that the card names. Its
        #         header.stamp is the time now:
        #         self.get_clock().now().to_msg()
        # TODO 9: put the distance into the field "range". Too near becomes
        #         -math.inf, too far becomes math.inf. Publish the message.


def main(args=None):
    """Run the node until Ctrl-C."""
    # This part is complete. You need it again in distance_subscriber.py.
    try:
        rclpy.init(args=args)
        rclpy.spin(DistanceSensor())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
