"""A goal as a coroutine and a timer, one thread; a second node in the process gives the goal."""

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.action import ActionClient, ActionServer
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from test_msgs.action import Fibonacci


class Driver(Node):
    """Drives until its way is long enough."""

    def __init__(self) -> None:
        super().__init__("driver")
        self.goal, self.done, self.x_m, self.begin_m = None, None, 0.0, 0.0
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Odometry, "odom", self.hear, 10)
        self.server = ActionServer(self, Fibonacci, "drive", self.drive)
        self.create_timer(0.05, self.step)

    def hear(self, odom: Odometry) -> None:
        """Where it is."""
        self.x_m = odom.pose.pose.position.x

    async def drive(self, goal_handle) -> Fibonacci.Result:  # noqa: ANN001
        """The goal's coroutine: it waits for what the timer finds."""
        self.goal, self.done, self.begin_m = goal_handle, Future(), self.x_m
        return Fibonacci.Result(sequence=[await self.done])

    def step(self) -> None:
        """Twenty times a second."""
        if self.goal is None:
            return
        left_m = self.begin_m + self.goal.request.order / 10 - self.x_m
        if left_m > 0.02:
            command = Twist()
            command.linear.x = min(0.3, 0.05 + left_m)
            self.publisher.publish(command)
            return
        self.publisher.publish(Twist())
        self.goal.succeed()
        self.goal = None
        self.done.set_result(1)


class Asker(Node):
    """Gives the next goal as soon as the last one is done."""

    def __init__(self) -> None:
        super().__init__("asker")
        self.client = ActionClient(self, Fibonacci, "drive")
        self.asked = False
        self.create_timer(0.5, self.ask)

    def ask(self) -> None:
        """Two times a second, while no goal is under way."""
        if self.asked or not self.client.server_is_ready():
            return
        self.asked = True
        self.client.send_goal_async(Fibonacci.Goal(order=4)).add_done_callback(self.accepted)

    def accepted(self, future: Future) -> None:
        """Wait for its result."""
        future.result().get_result_async().add_done_callback(self.ended)

    def ended(self, _: Future) -> None:
        """The next one may come."""
        self.asked = False


rclpy.init()
executor = SingleThreadedExecutor()
nodes = [Driver(), Asker()]
for node in nodes:
    executor.add_node(node)
executor.spin()
