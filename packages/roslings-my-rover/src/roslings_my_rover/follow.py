"""Follow the ball: what day 7's ball finder says on /ball becomes a command on /cmd_vel.

The ball finder tells the ball's column in the picture. The camera's focal length makes an angle of
it: bearing = atan((319.5 - x) / 530.5), positive to the left.
"""

import math

import rclpy
from geometry_msgs.msg import PointStamped, Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

MIDDLE_PX, FOCAL_PX = 319.5, 530.5
AHEAD_M_S, TURN_PER_S = 0.25, 1.5


class Follower(Node):  # type: ignore[misc]  # rclpy has no types
    """Turns to the ball, and drives to it while it is ahead."""

    def __init__(self) -> None:
        """Hear /ball, say /cmd_vel."""
        super().__init__("follower")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(PointStamped, "/ball", self.follow, 10)

    def follow(self, ball: PointStamped) -> None:
        """One command for each ball that was seen."""
        bearing = math.atan((MIDDLE_PX - ball.point.x) / FOCAL_PX)
        command = Twist()
        command.angular.z = TURN_PER_S * bearing
        command.linear.x = AHEAD_M_S if abs(bearing) < 0.3 else 0.0
        self.publisher.publish(command)


def main() -> None:
    """Run the follower until Ctrl-C."""
    try:
        rclpy.init()
        rclpy.spin(Follower())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
