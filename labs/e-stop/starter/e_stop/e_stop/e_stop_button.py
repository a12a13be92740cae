"""The button: tells everybody whether the rover must stand still.

Do the TODOs in the order of their numbers. The names, the texts and the times
that you need stand on the card, in labs/e-stop/task.md.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile

# TODO 3: import the message type and the service type that the card names, and
#         what you need of rclpy.qos and rclpy.duration.

# TODO 4: write the profile of the topic: it keeps its last message for late
#         joiners, and the middleware gives signs of life for it.
LATCHED = QoSProfile(depth=10)


class EStopButton(Node):
    """Keeps the last press for those who come late."""

    def __init__(self):
        # TODO 5: give the node the name from the card, without the slash. Then
        #         create the publisher with your profile, and the service.
        #         Tell at once what holds before anybody released the stop.
        super().__init__('change_me')

    def press(self, request, response):
        """Press (true) or release (false)."""
        # TODO 6: tell what is asked for, fill the response, and give it back.

    def tell(self, pressed):
        """Publish what holds from now on."""
        # TODO 7: publish a message with this value, once.


def main(args=None):
    """Run the button until Ctrl-C."""
    # This part is complete.
    try:
        rclpy.init(args=args)
        rclpy.spin(EStopButton())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
