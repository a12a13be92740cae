"""The bridge: wheel speeds from the board to ROS, commands from ROS to the board.

Do the TODOs in the order of their numbers. The names and numbers that you need
stand on the card, in labs/serial-bridge/task.md.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

# TODO 8: import serial, the three message types of the card, and what you need
#         from lines.py and wheels.py.


class SerialBridge(Node):
    """One board on one serial port."""

    def __init__(self):
        # TODO 9: give the node the name from the card.
        super().__init__('change_me')
        # TODO 10: declare the parameters of the card, with their defaults.
        # TODO 11: create the publishers and the subscription. Create three
        #          timers: one reads the board (100 times a second is enough), one
        #          sends the command (20 times a second), and one opens the port
        #          when it is not open (twice a second).

    def connect(self):
        """Open the port, if it is not open; called again and again."""
        # TODO 12: open it with serial.Serial(..., timeout=0, write_timeout=0.2,
        #          exclusive=True). With timeout=0, read() does not wait. Without a
        #          board this raises OSError: log a warning, and try again later.

    def read_board(self):
        """Publish what the board says."""
        # TODO 13: read all bytes that wait, and feed them to the LineReader. Each
        #          body that begins with W, becomes one message on each topic. An
        #          OSError means that the cable was pulled: close the port.

    def publish(self, ms, left, right):
        """Publish one line of wheel speeds (rad/s) and the place after it."""
        # TODO 14: the seconds since the line before come from MS, the board's own
        #          clock. Fill the fields that the card names. A turn by an angle a
        #          about the upright axis is the quaternion z = sin(a/2),
        #          w = cos(a/2). The twist of /odom has the motion: linear.x in m/s,
        #          angular.z in rad/s.

    def take_command(self, twist):
        """Remember a command, if it is one that a robot can follow."""
        # TODO 15: keep forward (linear.x), turn (angular.z) and the time. What is
        #          no finite number is left aside.

    def send_command(self):
        """Tell the board the command of now; zero when none came for a while."""
        # TODO 16: wheel speeds, then PWM. When one wheel would need more than
        #          PWM 255, slow both alike. An OSError means that the cable was
        #          pulled: close the port.


def main(args=None):
    """Run the node until Ctrl-C."""
    # This part is complete.
    try:
        rclpy.init(args=args)
        rclpy.spin(SerialBridge())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
