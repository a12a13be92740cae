"""The drive client: sends the rover to a point, shows how it gets on, and ends."""

import rclpy
from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rover_interfaces.action import DriveTo


class DriveClient(Node):
    """Gives one goal to the drive server."""

    def __init__(self):
        super().__init__('drive_client')
        self.declare_parameter('x', 3.0)
        self.declare_parameter('y', 5.0)
        self.declare_parameter('tolerance', 0.1)
        self.client = ActionClient(self, DriveTo, 'drive_to')

    def send_rover(self):
        """Give the goal and wait for its end; whether the rover got there."""
        if not self.client.wait_for_server(timeout_sec=2.0):
            self.get_logger().error('No server for /drive_to')
            return False
        goal_handle = self.wait_for(
            self.client.send_goal_async(self.goal(), feedback_callback=self.show)
        )
        if not goal_handle.accepted:
            self.get_logger().error('The goal was refused')
            return False
        answer = self.wait_for(goal_handle.get_result_async())
        if answer.status != GoalStatus.STATUS_SUCCEEDED:
            self.get_logger().error('The rover did not get there')
            return False
        elapsed = answer.result.elapsed
        self.get_logger().info(f'The rover is there after {elapsed:.1f} s')
        return True

    def goal(self):
        """The goal, as the parameters have it."""
        goal = DriveTo.Goal()
        goal.x = self.get_parameter('x').value
        goal.y = self.get_parameter('y').value
        goal.tolerance = self.get_parameter('tolerance').value
        return goal

    def show(self, message):
        """Write how far it still is."""
        self.get_logger().info(f'Distance: {message.feedback.distance:.2f} m')

    def wait_for(self, future):
        """Spin until the answer is there."""
        rclpy.spin_until_future_complete(self, future)
        return future.result()


def main(args=None):
    """Send the rover once; the exit code is 0 where it got there, else 1."""
    try:
        rclpy.init(args=args)
        return 0 if DriveClient().send_rover() else 1
    except (KeyboardInterrupt, ExternalShutdownException):
        return 1
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    raise SystemExit(main())
