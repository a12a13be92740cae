"""`ros2 run teleop_twist_keyboard teleop_twist_keyboard`: drives a robot by the keys.

Topic and parameters are those of the package of this name; the program is our own.
"""

import sys

import rclpy
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from ros2_on_pip.keyboard import HELP, Hands, Keys, NoKeys, Steering, keys_of

WRONG_USE = 2
LOOK_S = 0.1
TIMES_AGAIN = 3
"""A robot that has only just found us may miss the first message, so the newest key is repeated."""


class Teleop(Node):
    """Publishes on `cmd_vel` what each key says."""

    def __init__(self) -> None:
        super().__init__("teleop_twist_keyboard")
        speed_m_s = self.declare_parameter("speed", 0.5).value
        turn_rad_s = self.declare_parameter("turn", 1.0).value
        self.stamped = self.declare_parameter("stamped", False).value
        self.frame_id = self.declare_parameter("frame_id", "").value
        self.again = 0
        self.hands = Hands(float(speed_m_s), float(turn_rad_s))
        self.publisher = self.create_publisher(
            TwistStamped if self.stamped else Twist, "cmd_vel", 10
        )

    def press(self, key: str) -> None:
        """Follow a key, and tell the robot."""
        self.hands = self.hands.press(key)
        self.again = TIMES_AGAIN
        self.tell(self.hands.steering)

    def tell_again(self) -> None:
        """The newest key once more, as soon as somebody hears it."""
        if self.again and self.publisher.get_subscription_count():
            self.again -= 1
            self.tell(self.hands.steering)

    def tell(self, steering: Steering) -> None:
        """Publish it, and show it."""
        twist = Twist()
        twist.linear.x = steering.forward_m_s
        twist.angular.z = steering.turn_rad_s
        self.publisher.publish(self.with_stamp(twist) if self.stamped else twist)
        said = f"ahead {steering.forward_m_s:5.2f} m/s   turn {steering.turn_rad_s:5.2f} rad/s"
        beside = f"keys: {self.hands.speed_m_s:.2f} m/s, {self.hands.turn_rad_s:.2f} rad/s"
        if not self.publisher.get_subscription_count():
            beside = "nobody hears it: does the robot run?"
        print(f"\r{said}   {beside:40}", end="", flush=True)

    def with_stamp(self, twist: Twist) -> TwistStamped:
        """The same with a header."""
        message = TwistStamped(twist=twist)
        message.header.stamp = self.get_clock().now().to_msg()
        message.header.frame_id = self.frame_id
        return message


def drive(node: Teleop, keys: Keys) -> None:
    """Until Ctrl-C; then the robot is told to stand."""
    try:
        while rclpy.ok():
            if key := keys.next(LOOK_S):
                node.press(key)
            else:
                node.tell_again()
            rclpy.spin_once(node, timeout_sec=0.0)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        if rclpy.ok():
            node.tell(Steering())
        print()


def main() -> int:
    """Run the node; 2 where there is no terminal."""
    try:
        with keys_of() as keys:
            print(f"{HELP}\nCtrl-C ends it.\n", flush=True)
            rclpy.init(signal_handler_options=rclpy.SignalHandlerOptions.NO)
            drive(Teleop(), keys)
    except NoKeys as error:
        print(f"teleop_twist_keyboard: {error}", file=sys.stderr)
        return WRONG_USE
    except KeyboardInterrupt:
        pass
    finally:
        rclpy.try_shutdown()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
