"""A goal's loop that awaits the tick of a timer, as day 5 teaches it; it gives itself the goals."""

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.action import ActionClient, ActionServer
from rclpy.node import Node
from rclpy.task import Future
from test_msgs.action import Fibonacci


class Driver(Node):
    """Drives until its way is long enough, again and again."""

    def __init__(self) -> None:
        super().__init__("driver")
        self.tick, self.asked, self.x_m = Future(), False, 0.0
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Odometry, "odom", self.hear, 10)
        self.server = ActionServer(self, Fibonacci, "drive", self.drive)
        self.client = ActionClient(self, Fibonacci, "drive")
        self.create_timer(0.1, self.next_tick)
        self.create_timer(0.5, self.ask)

    def hear(self, odom: Odometry) -> None:
        """Where it is."""
        self.x_m = odom.pose.pose.position.x

    def next_tick(self) -> None:
        """Let who awaits the tick go on, and begin the next one."""
        tick, self.tick = self.tick, Future()
        tick.set_result(None)

    async def drive(self, goal_handle) -> Fibonacci.Result:  # noqa: ANN001
        """The loop of the goal."""
        end_m = self.x_m + goal_handle.request.order / 10
        while True:
            await self.tick
            left_m = end_m - self.x_m
            if left_m < 0.02:
                break
            command = Twist()
            command.linear.x = min(0.3, 0.05 + left_m)
            self.publisher.publish(command)
        self.publisher.publish(Twist())
        goal_handle.succeed()
        return Fibonacci.Result()

    def ask(self) -> None:
        """Two times a second, while no goal is under way."""
        if not self.asked and self.client.server_is_ready():
            self.asked = True
            self.client.send_goal_async(Fibonacci.Goal(order=4)).add_done_callback(self.accepted)

    def accepted(self, future: Future) -> None:
        """Wait for its result."""
        future.result().get_result_async().add_done_callback(self.ended)

    def ended(self, _: Future) -> None:
        """The next one may come."""
        self.asked = False


rclpy.init()
rclpy.spin(Driver())
