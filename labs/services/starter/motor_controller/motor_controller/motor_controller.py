"""The motor controller: limits the rover's speed, and takes the limit away.

Do the TODOs in the order of their numbers. The names, the texts and the times
that you need stand on the card, in labs/services/task.md.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

# TODO 3: import the message type and the two service types that the card
#         names. A service type comes from the part "srv" of its package.

FULL_SPEED = 1.0  # m/s
LIMITED_SPEED = 0.3


class MotorController(Node):
    """Keeps the maximum speed, serves those who change it, and publishes it."""

    def __init__(self):
        # TODO 4: give the node the name from the card, without the slash.
        super().__init__('change_me')
        self.max_speed = FULL_SPEED
        # TODO 5: create a publisher for the state (queue length 10), and a
        #         timer that calls self.tell_state at the card's rate.
        # TODO 7: create the first service: type, name, self.set_max_speed.
        # TODO 9: create the second service: type, name, self.reset.

    def tell_state(self):
        """Publish the maximum speed that holds now."""
        # TODO 6: publish a message with self.max_speed in its field "data".

    def set_max_speed(self, request, response):
        """Switch the limit on (true) or off (false)."""
        # TODO 8: set self.max_speed by request.data. Fill response.success
        #         and response.message. End with: return response

    def reset(self, request, response):
        """Take the limit away, where there is one."""
        # TODO 10: the card has two cases: the limit is on, or it is off
        #          already. Do not call the other service from here: set
        #          self.max_speed. In both cases end with: return response


def main(args=None):
    """Run the server until Ctrl-C."""
    # This part is complete.
    try:
        rclpy.init(args=args)
        rclpy.spin(MotorController())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
