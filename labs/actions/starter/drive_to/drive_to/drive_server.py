"""The drive server: performs the action that drives the rover to a point of its map.

Do the TODOs in the order of their numbers. The names, the numbers and the times
that you need stand on the card, in labs/actions/task.md.
"""

import math

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.task import Future

# TODO 3: import ActionServer, CancelResponse and GoalResponse from rclpy.action,
#         and the action type that the card names. An action type comes from the
#         part "action" of its package.

# TODO 7: the edges of the map, in metres: WEST, EAST, SOUTH, NORTH = ...
PERIOD = 0.1  # seconds between two feedbacks


class DriveServer(Node):
    """Hears where the rover is, and tells it how to drive."""

    def __init__(self):
        # TODO 4: give the node the name from the card, without the slash.
        super().__init__('change_me')
        self.place = None  # x, y and heading, once /odom has told
        self.busy = False
        self.publisher = self.create_publisher(Twist, 'cmd_vel', 10)
        self.create_subscription(Odometry, 'odom', self.hear, 10)
        # TODO 5: create the action server: ActionServer(self, TYPE, NAME,
        #         execute_callback=self.drive, goal_callback=self.judge_goal,
        #         cancel_callback=self.judge_cancel). Keep it as self.server.
        # A timer ends the tick, ten times a second, and begins the next one.
        self.tick = Future()
        self.create_timer(PERIOD, self.next_tick)

    def hear(self, odometry):
        """Note where the rover is."""
        # This part is complete.
        pose = odometry.pose.pose
        heading = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
        self.place = (pose.position.x, pose.position.y, heading)

    def next_tick(self):
        """Let who awaits the tick go on, and begin the next one."""
        # This part is complete.
        tick, self.tick = self.tick, Future()
        tick.set_result(None)

    def seconds(self):
        """What the node's clock says, which may be that of a simulation."""
        # This part is complete.
        return self.get_clock().now().nanoseconds / 1e9

    def judge_goal(self, goal):
        """Accept a goal on the map, one at a time."""
        # TODO 6: return GoalResponse.ACCEPT. Where it accepts, it first sets
        #         self.busy to True: from then on the rover has work.
        # TODO 8: before that, return GoalResponse.REJECT for each goal that the
        #         card refuses, while self.busy is True, and while self.place is
        #         None: nobody has told yet where the rover is.

    def judge_cancel(self, goal_handle):
        """Whoever drives can be stopped."""
        # TODO 10: return CancelResponse.ACCEPT.

    async def drive(self, goal_handle):
        """Drive until the rover is there, or until somebody cancels."""
        # TODO 9: goal_handle.request is the goal. In a loop:
        #         - wait with: await self.tick. Meanwhile the node hears where
        #           the rover is. With time.sleep it would hear nothing;
        #         - publish the feedback: fill a TYPE.Feedback() and give it to
        #           goal_handle.publish_feedback;
        #         - where the rover is within the tolerance, leave the loop;
        #         - publish the command that steer(self.place, goal) gives.
        #         After the loop: publish an empty Twist(), so that the rover
        #         stands. Set self.busy to False. Fill a TYPE.Result(): elapsed is
        #         the difference of self.seconds() at the end and at the begin.
        #         Call goal_handle.succeed(), and return the result.
        # TODO 11: leave the loop also where goal_handle.is_cancel_requested is
        #          True. Then call goal_handle.canceled(), not succeed().


def steer(place, goal):
    """The next command: turn until the goal lies ahead, then drive."""
    # This part is complete.
    x, y, heading = place
    direction = math.atan2(goal.y - y, goal.x - x)
    turn = math.remainder(direction - heading, math.tau)
    command = Twist()
    command.angular.z = max(-2.0, min(2.0, 2.0 * turn))  # rad/s
    if abs(turn) < 0.3:
        distance = math.hypot(goal.x - x, goal.y - y)
        command.linear.x = max(0.1, min(0.5, distance))  # m/s, slower near the goal
    return command


def main(args=None):
    """Run the server until Ctrl-C."""
    # This part is complete.
    try:
        rclpy.init(args=args)
        rclpy.spin(DriveServer())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
