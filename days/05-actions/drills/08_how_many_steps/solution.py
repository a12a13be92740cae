"""Foretell: a client gives the goal 80 percent. How many lines with "level" are
written? Write the number, then check."""

import rclpy
from rclpy.action import ActionServer
from rclpy.node import Node
from rover_interfaces.action import Charge

ANSWER = 3


class Charger(Node):
    def __init__(self):
        super().__init__("charger")
        self.level = 20.0
        self.server = ActionServer(self, Charge, "charge", self.fill)

    def fill(self, goal_handle):
        while self.level < goal_handle.request.target:
            self.level += 25.0
            print(f"level {self.level:.0f}", flush=True)
            goal_handle.publish_feedback(Charge.Feedback(level=self.level))
        goal_handle.succeed()
        return Charge.Result(level=self.level)


def main():
    rclpy.init()
    rclpy.spin(Charger())


main()
