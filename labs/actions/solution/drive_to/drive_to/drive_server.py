"""The drive server: performs the action that drives the rover to a point of its map."""

import math

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.task import Future
from rover_interfaces.action import DriveTo

WEST, EAST, SOUTH, NORTH = -2.0, 8.0, -2.0, 7.0  # the map, in metres
PERIOD = 0.1  # seconds between two feedbacks


class DriveServer(Node):
    """Hears where the rover is, and tells it how to drive."""

    def __init__(self):
        super().__init__('drive_server')
        self.place = None  # x, y and heading, once /odom has told
        self.busy = False
        self.publisher = self.create_publisher(Twist, 'cmd_vel', 10)
        self.create_subscription(Odometry, 'odom', self.hear, 10)
        self.server = ActionServer(
            self,
            DriveTo,
            'drive_to',
            execute_callback=self.drive,
            goal_callback=self.judge_goal,
            cancel_callback=self.judge_cancel,
        )
        self.tick = Future()
        self.create_timer(PERIOD, self.next_tick)

    def hear(self, odometry):
        """Note where the rover is."""
        pose = odometry.pose.pose
        heading = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
        self.place = (pose.position.x, pose.position.y, heading)

    def next_tick(self):
        """Let who awaits the tick go on, and begin the next one."""
        tick, self.tick = self.tick, Future()
        tick.set_result(None)

    def seconds(self):
        """What the node's clock says, which may be that of a simulation."""
        return self.get_clock().now().nanoseconds / 1e9

    def judge_goal(self, goal):
        """Accept a goal on the map, one at a time."""
        if self.busy or self.place is None or not possible(goal):
            return GoalResponse.REJECT
        self.busy = True
        return GoalResponse.ACCEPT

    def judge_cancel(self, goal_handle):
        """Whoever drives can be stopped."""
        return CancelResponse.ACCEPT

    async def drive(self, goal_handle):
        """Drive until the rover is there, or until somebody cancels."""
        goal = goal_handle.request
        began = self.seconds()
        result = DriveTo.Result()
        while True:
            await self.tick  # the node hears and answers meanwhile
            distance = self.distance_to(goal)
            self.tell(goal_handle, distance)
            if distance < 0.8 * goal.tolerance:
                result.reached = True
                break
            if goal_handle.is_cancel_requested:
                break
            self.publisher.publish(steer(self.place, goal))
        self.publisher.publish(Twist())  # stand still
        self.busy = False
        result.elapsed = self.seconds() - began
        if result.reached:
            goal_handle.succeed()
        elif goal_handle.is_cancel_requested:
            goal_handle.canceled()
        return result

    def distance_to(self, goal):
        """How far the rover is from the goal, in metres."""
        x, y, _ = self.place
        return math.hypot(goal.x - x, goal.y - y)

    def tell(self, goal_handle, distance):
        """Publish the feedback."""
        feedback = DriveTo.Feedback()
        feedback.x, feedback.y, _ = self.place
        feedback.distance = distance
        goal_handle.publish_feedback(feedback)


def possible(goal):
    """Whether the rover can get there: nan is in no interval."""
    return (
        WEST <= goal.x <= EAST
        and SOUTH <= goal.y <= NORTH
        and 0.0 < goal.tolerance < math.inf
    )


def steer(place, goal):
    """The next command: turn until the goal lies ahead, then drive."""
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
    try:
        rclpy.init(args=args)
        rclpy.spin(DriveServer())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
