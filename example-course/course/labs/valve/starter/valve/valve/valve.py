"""The valve: a managed node that others lead from state to state."""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node


class Valve(Node):  # TODO 1: make it a managed node
    """Opens where it is activated."""

    def __init__(self):
        super().__init__('valve')

    # TODO 2: on_activate(self, state) and on_deactivate(self, state)


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
