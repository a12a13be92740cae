"""A timer that awaits the next /odom."""

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from rclpy.task import Future


class Follower(Node):
    """Each turn of its timer goes on when a new place is there."""

    def __init__(self) -> None:
        super().__init__("follower")
        self.next = None
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        # The timer holds its own group while it waits: what it waits for needs another one.
        other = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Odometry, "odom", self.hear, 10, callback_group=other)
        self.create_timer(0.1, self.step)

    def hear(self, odom: Odometry) -> None:
        """Wake who waits."""
        if self.next is not None:
            waiting, self.next = self.next, None
            waiting.set_result(odom)

    async def step(self) -> None:
        """Ten times a second."""
        if self.next is not None:
            return
        self.next = Future()
        odom = await self.next
        command = Twist()
        command.linear.x = 0.2
        command.angular.z = 0.5 - odom.pose.pose.position.y
        self.publisher.publish(command)


rclpy.init()
rclpy.spin(Follower())
