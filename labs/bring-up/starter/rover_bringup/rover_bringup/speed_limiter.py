"""The speed limiter: passes each command on, no faster than its parameters allow.

Do the TODOs in the order of their numbers. The names and the numbers that you need
stand on the card, in labs/bring-up/task.md.
"""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

# TODO 3: import FloatingPointRange, ParameterDescriptor and SetParametersResult
#         from rcl_interfaces.msg.


class SpeedLimiter(Node):
    """Hears the speed that somebody wants, and publishes the one that is allowed."""

    def __init__(self):
        # TODO 4: give the node the name from the card. Declare its three parameters,
        #         with their defaults. Two of them have a range: describe it.
        super().__init__('change_me')
        # TODO 6: let ROS ask self.judge before it sets parameters.
        self.publisher = self.create_publisher(Twist, 'cmd_vel', 10)
        self.create_subscription(Twist, 'cmd_vel_in', self.limit, 10)

    def judge(self, parameters):
        """Say whether new values may be set; nothing is set here."""
        # TODO 7: return a SetParametersResult. It says no where slow_speed would
        #         be above max_speed. What is not in the list keeps its value.

    def limit(self, command):
        """Publish a command with its speed cut to the limit."""
        # TODO 5: read the limit from the parameter that counts now. A speed that is
        #         no number (math.isnan tells) becomes 0.
        limit = 0.5  # m/s
        command.linear.x = max(-limit, min(command.linear.x, limit))
        self.publisher.publish(command)


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(SpeedLimiter())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
