"""The motor client: asks once for the speed limit, says the answer, and ends.

Go on here when the server answers `ros2 service call`.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

# TODO 11: import the service type of the first service.


class MotorClient(Node):
    """Asks the motor controller to switch the limit on."""

    def __init__(self):
        # TODO 12: give the node the name from the card, without the slash.
        super().__init__('change_me')
        # TODO 13: create a client: service type, service name. Keep it as
        #          self.client.

    def limit_speed(self):
        """Ask, wait for the answer and log it; False where there is no server."""
        # TODO 14: wait for the server, 2 seconds at most. Where there is none,
        #          log the line that the card asks for, and return False.
        # TODO 15: make a request, set its field "data", and send it with
        #          call_async. It gives back a "future": the answer that will
        #          come. Let rclpy spin until the future is complete.
        # TODO 16: log the answer's message as the card says, and return True.
        return False


def main(args=None):
    """Ask once; the exit code is 0 after an answer, and 1 without a server."""
    # This part is complete.
    try:
        rclpy.init(args=args)
        return 0 if MotorClient().limit_speed() else 1
    except (KeyboardInterrupt, ExternalShutdownException):
        return 1
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    raise SystemExit(main())
