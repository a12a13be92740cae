"""Ends by itself after two seconds of robot time."""

import rclpy
from rclpy.node import Node


class Follower(Node):
    """Counts the turns of its timer."""

    def __init__(self) -> None:
        super().__init__("follower")
        self.turns = 0
        self.create_timer(0.5, self.step)

    def step(self) -> None:
        """The fourth is the last."""
        self.turns += 1
        if self.turns > 4:
            raise SystemExit(3)


rclpy.init()
rclpy.spin(Follower())
