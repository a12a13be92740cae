"""A rover that follows a wall in any room, and lets pass what moves."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan

WALL_AT = 0.4  # metres from the laser
STOP_AT = 0.4  # metres ahead of the laser
TIGHT_AT = 0.22  # metres around the front: the hull begins at 0.12
FASTEST = 0.25  # metres a second
FASTEST_TURN = 1.5  # radians a second
LOST = 1.0  # metres more than the wall should be away: there is no wall
LOOKS_FOR = 0.5  # seconds that it stands before it turns away from a wall
WAITS_FOR = 3.0  # seconds that it stands before something that has moved
HAS_MOVED = 0.03  # metres from one scan to the next, while the rover stands


def by_degrees(scan, sign):
    """Give the distance in each whole degree; positive ones are on the wall's side."""
    found = dict.fromkeys(range(-180, 180), math.inf)
    for number, distance in enumerate(scan.ranges):
        angle = sign * (scan.angle_min + number * scan.angle_increment)
        degrees = round(math.degrees(angle) + 180) % 360 - 180
        if not math.isnan(distance):  # -inf is too near, inf is nothing at all
            found[degrees] = min(found[degrees], max(distance, 0.0))
    return found


def nearest(seen, first, last):
    """Return the smallest distance between two angles."""
    return min(seen[degrees] for degrees in range(first, last + 1))


def along_the_wall(seen):
    """Forward and turn that keep the distance; a turn to the wall is positive."""
    ahead = nearest(seen, -25, 25)
    where = min(range(20, 151), key=lambda degrees: seen[degrees])
    off = seen[where] - WALL_AT
    forward = min(FASTEST, ahead - STOP_AT + 0.05)
    if off > LOST:
        return forward, 0.0
    aim = math.radians(where - 90) + max(-0.8, min(0.8, 2.0 * off))
    turn = max(-FASTEST_TURN, min(FASTEST_TURN, 2.0 * aim))
    return min(FASTEST * (1 - 0.7 * abs(turn) / FASTEST_TURN), forward), turn


class Wander(Node):
    """Answers each scan with a command."""

    def __init__(self):
        super().__init__('wander')
        self.declare_parameter('side', 'left')
        self.publisher = self.create_publisher(Twist, 'cmd_vel', 10)
        self.create_subscription(LaserScan, 'scan', self.look, qos_profile_sensor_data)
        self.stands_since = None
        self.goes_at = 0.0
        self.ahead = math.inf

    def look(self, scan):
        """Say what to do now."""
        sign = 1 if self.get_parameter('side').value == 'left' else -1
        now = Time.from_msg(scan.header.stamp).nanoseconds / 1e9
        forward, turn = self.decide(by_degrees(scan, sign), now)
        command = Twist()
        command.linear.x, command.angular.z = forward, sign * turn
        self.publisher.publish(command)

    def decide(self, seen, now):
        """Follow the wall, stand before what is in the way, or turn away from it."""
        ahead = nearest(seen, -25, 25)
        if ahead >= STOP_AT and nearest(seen, -60, 60) >= TIGHT_AT:
            self.stands_since = None
            return along_the_wall(seen)
        if self.stands_since is None:
            self.stands_since, self.goes_at = now, now + LOOKS_FOR
        elif now < self.goes_at and abs(ahead - self.ahead) > HAS_MOVED:
            self.goes_at = now + WAITS_FOR
        self.ahead = ahead
        return 0.0, -FASTEST_TURN / 2 if now >= self.goes_at else 0.0


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Wander())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
