"""The guard: stands between the operator and the motors, and stops the rover."""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.duration import Duration
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
)
from std_msgs.msg import Bool

BUTTON = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
    liveliness=LivelinessPolicy.AUTOMATIC,
    liveliness_lease_duration=Duration(seconds=2.0),
)
COMMANDS = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.BEST_EFFORT,
    deadline=Duration(seconds=0.4),
)
MOTORS = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    deadline=Duration(seconds=0.2),
    lifespan=Duration(seconds=0.5),
)


class Guard(Node):
    """Passes commands on, as long as there is no reason to stop."""

    def __init__(self):
        super().__init__('guard')
        self.pressed = True  # until the button says that it is not
        self.lost = True  # until a button is there
        self.silent = True  # until a command comes
        self.command = Twist()
        self.reason = None
        self.publisher = self.create_publisher(Twist, 'cmd_vel', MOTORS)
        self.create_subscription(
            Bool,
            'e_stop',
            self.hear_button,
            BUTTON,
            event_callbacks=SubscriptionEventCallbacks(liveliness=self.count_buttons),
        )
        self.create_subscription(
            Twist,
            'cmd_vel_raw',
            self.hear_command,
            COMMANDS,
            event_callbacks=SubscriptionEventCallbacks(deadline=self.miss_command),
        )
        self.create_timer(0.05, self.tell_motors)  # seconds

    def hear_button(self, message):
        """Somebody pressed or released the stop."""
        self.pressed = message.data
        self.tell_reason()

    def count_buttons(self, event):
        """A button came, or is gone."""
        self.lost = event.alive_count == 0
        self.tell_reason()

    def hear_command(self, message):
        """The operator wants something."""
        self.command = message
        self.silent = False
        self.tell_reason()

    def miss_command(self, event):
        """No command came within the deadline."""
        self.silent = True
        self.tell_reason()

    def find_reason(self):
        """Say why the rover must stand still; nothing where it may drive."""
        if self.lost:
            return 'no button'
        if self.pressed:
            return 'the stop is pressed'
        if self.silent:
            return 'no commands'
        return None

    def tell_motors(self):
        """Publish the command, or zero."""
        self.publisher.publish(Twist() if self.find_reason() else self.command)

    def tell_reason(self):
        """Write why the rover stops, when that is new."""
        reason = self.find_reason()
        if reason and reason != self.reason:
            self.get_logger().info(f'Stopped: {reason}')
        self.reason = reason


def main(args=None):
    """Run the guard until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Guard())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
