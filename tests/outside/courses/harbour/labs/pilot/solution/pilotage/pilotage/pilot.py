"""A pilot: it follows a quay on one side, and stops before what comes in its way."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

AT_M = 0.4
FAST_M_S = 0.25
TURNS_RAD_S = 1.5


def steer(ranges, side):
    """Forward in m/s, and a turn in rad/s, from one turn of the scanner."""
    sign = 1 if side == 'left' else -1
    seen = {
        degrees: ranges[sign * degrees % len(ranges)] for degrees in range(-60, 151)
    }
    nearest = min(range(20, 151), key=lambda degrees: seen[degrees])
    ahead_m = min(seen[degrees] for degrees in range(-25, 26))
    around_m = min(seen[degrees] for degrees in range(-60, 61))
    if ahead_m < 0.4 or around_m < 0.22:
        return 0.0, -sign * TURNS_RAD_S / 2
    off_m = seen[nearest] - AT_M
    if off_m > 1.0:
        return min(FAST_M_S, ahead_m - 0.35), 0.0
    aim = math.radians(nearest - 90) + max(-0.8, min(0.8, 2.0 * off_m))
    turn = max(-TURNS_RAD_S, min(TURNS_RAD_S, 2.0 * aim))
    slower = 1 - 0.7 * abs(turn) / TURNS_RAD_S
    return min(FAST_M_S * slower, ahead_m - 0.35), sign * turn


class Pilot(Node):
    """One node, which answers each scan."""

    def __init__(self):
        super().__init__('pilot')
        self.side = self.declare_parameter('quay', 'left').value
        self.publisher = self.create_publisher(Twist, 'cmd_vel', 10)
        self.create_subscription(LaserScan, 'scan', self.look, qos_profile_sensor_data)

    def look(self, scan):
        """Say what to do now."""
        command = Twist()
        command.linear.x, command.angular.z = steer(scan.ranges, self.side)
        self.publisher.publish(command)


def main():
    """Spin until Ctrl-C."""
    rclpy.init()
    try:
        rclpy.spin(Pilot())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
