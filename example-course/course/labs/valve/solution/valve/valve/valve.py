"""The valve: a managed node that others lead from state to state."""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn


class Valve(LifecycleNode):
    """Opens where it is activated."""

    def __init__(self):
        super().__init__('valve')
        self.open = False

    def on_activate(self, state):
        """Open the valve."""
        self.open = True
        self.get_logger().info('The valve is open')
        return TransitionCallbackReturn.SUCCESS

    def on_deactivate(self, state):
        """Close the valve."""
        self.open = False
        self.get_logger().info('The valve is closed')
        return TransitionCallbackReturn.SUCCESS


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Valve())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
