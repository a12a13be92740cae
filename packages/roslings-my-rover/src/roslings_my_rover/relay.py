"""The relay: the one part of your rover that you have not written. Read it, it is short.

It hears the newest command on `commands`, and passes it on 20 times a second on `checked`. It is
slower where /motor_state says a limit, and not forward while /obstacle is true. It is zero when no
command came for 1.5 s. The guard of day 10 asks for 0.4 s between two commands, so somebody has to
repeat them.
"""

import math
import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from std_msgs.msg import Bool, Float64

PERIOD_S = 0.05
COMMAND_LASTS_S = 1.5
NEWS_LASTS_S = 1.0
"""Who has said nothing for so long is not there any more: the rover goes on without it."""


class Relay(Node):  # type: ignore[misc]  # rclpy has no types
    """Passes commands on, and keeps to what the other parts say."""

    def __init__(self) -> None:
        """Hear three topics, say one."""
        super().__init__("relay")
        self.command, self.command_s = Twist(), -math.inf
        self.limit_m_s, self.limit_s = math.inf, -math.inf
        self.blocked, self.blocked_s = False, -math.inf
        self.create_subscription(Twist, "commands", self.take_command, 10)
        self.create_subscription(Float64, "/motor_state", self.take_limit, qos_profile_sensor_data)
        self.create_subscription(Bool, "/obstacle", self.take_obstacle, qos_profile_sensor_data)
        often = QoSProfile(depth=1, deadline=Duration(seconds=2 * PERIOD_S))
        self.publisher = self.create_publisher(Twist, "checked", often)
        self.create_timer(PERIOD_S, self.pass_on)

    def take_command(self, command: Twist) -> None:
        """Keep the newest one."""
        self.command, self.command_s = command, time.monotonic()

    def take_limit(self, state: Float64) -> None:
        """Keep the limit of day 4, in m/s; what would let the rover only stand is none."""
        if state.data > 0:
            self.limit_m_s, self.limit_s = state.data, time.monotonic()

    def take_obstacle(self, obstacle: Bool) -> None:
        """Keep whether something is in the way (day 3)."""
        self.blocked, self.blocked_s = obstacle.data, time.monotonic()

    def pass_on(self) -> None:
        """Say what the motors may do now."""
        now_s = time.monotonic()
        checked = Twist()
        if now_s - self.command_s < COMMAND_LASTS_S:
            checked.linear.x, checked.angular.z = self.command.linear.x, self.command.angular.z
        if now_s - self.limit_s < NEWS_LASTS_S and abs(checked.linear.x) > self.limit_m_s:
            slower = self.limit_m_s / abs(checked.linear.x)
            checked.linear.x *= slower
            checked.angular.z *= slower  # it stays on its curve
        if now_s - self.blocked_s < NEWS_LASTS_S and self.blocked and checked.linear.x > 0:
            checked.linear.x = 0.0
        self.publisher.publish(checked)


def main() -> None:
    """Run the relay until Ctrl-C."""
    try:
        rclpy.init()
        rclpy.spin(Relay())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
