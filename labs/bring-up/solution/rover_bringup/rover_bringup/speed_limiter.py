"""The speed limiter: passes each command on, no faster than its parameters allow."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rcl_interfaces.msg import (
    FloatingPointRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node


def between(least, most):
    """Describe a parameter that is a number from `least` to `most`."""
    limits = FloatingPointRange(from_value=least, to_value=most)
    return ParameterDescriptor(floating_point_range=[limits])


class SpeedLimiter(Node):
    """Hears the speed that somebody wants, and publishes the one that is allowed."""

    def __init__(self):
        super().__init__('speed_limiter')
        self.declare_parameter('max_speed', 0.5, between(0.1, 1.0))  # m/s
        self.declare_parameter('slow_speed', 0.2, between(0.05, 0.5))
        self.declare_parameter('careful', False)
        self.add_on_set_parameters_callback(self.judge)
        self.publisher = self.create_publisher(Twist, 'cmd_vel', 10)
        self.create_subscription(Twist, 'cmd_vel_in', self.limit, 10)

    def judge(self, parameters):
        """Say whether new values may be set; nothing is set here."""
        new = {parameter.name: parameter.value for parameter in parameters}
        max_speed = new.get('max_speed', self.get_parameter('max_speed').value)
        slow_speed = new.get('slow_speed', self.get_parameter('slow_speed').value)
        if slow_speed > max_speed:
            reason = f'slow_speed {slow_speed} is above max_speed {max_speed}'
            return SetParametersResult(successful=False, reason=reason)
        return SetParametersResult(successful=True)

    def limit(self, command):
        """Publish a command with its speed cut to the limit."""
        careful = self.get_parameter('careful').value
        name = 'slow_speed' if careful else 'max_speed'
        limit = self.get_parameter(name).value
        if math.isnan(command.linear.x):
            command.linear.x = 0.0  # each comparison with nan is False
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
