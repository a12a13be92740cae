"""The drive client: sends the rover to a point, shows how it gets on, and ends.

Go on here when the server drives, and can be cancelled.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

# TODO 12: import ActionClient from rclpy.action, GoalStatus from action_msgs.msg,
#          and the action type.


class DriveClient(Node):
    """Gives one goal to the drive server."""

    def __init__(self):
        # TODO 13: give the node the name from the card, without the slash.
        super().__init__('change_me')
        # TODO 14: declare the parameters of the card, each with its default.
        #          Create the action client: ActionClient(self, TYPE, NAME).
        #          Keep it as self.client.

    def send_rover(self):
        """Give the goal and wait for its end; whether the rover got there."""
        # TODO 15: wait for the server, 2 seconds at most: wait_for_server. Where
        #          there is none, log the line of the card, and return False.
        # TODO 16: send self.goal() with send_goal_async, and with
        #          feedback_callback=self.show. self.wait_for(...) gives you the
        #          goal's handle. Where its field "accepted" is False, log the
        #          line of the card, and return False.
        # TODO 17: self.wait_for(HANDLE.get_result_async()) gives you the answer:
        #          a status and a result. Compare the status with
        #          GoalStatus.STATUS_SUCCEEDED. Log the card's line for each
        #          case. Return True where the rover is there, else False.
        return False

    def goal(self):
        """The goal, as the parameters have it."""
        # TODO 18: return a TYPE.Goal() with x, y and tolerance from the
        #          parameters.

    def show(self, message):
        """Write how far it still is: message.feedback is the feedback."""
        # TODO 19: log the card's line, with two digits: f'{NUMBER:.2f}'

    def wait_for(self, future):
        """Spin until the answer is there."""
        # This part is complete.
        rclpy.spin_until_future_complete(self, future)
        return future.result()


def main(args=None):
    """Send the rover once; the exit code is 0 where it got there, else 1."""
    # This part is complete.
    try:
        rclpy.init(args=args)
        return 0 if DriveClient().send_rover() else 1
    except (KeyboardInterrupt, ExternalShutdownException):
        return 1
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    raise SystemExit(main())
