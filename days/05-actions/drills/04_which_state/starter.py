"""Foretell: a client gives the goal 90 percent. In which state does the goal end:
"succeeded", "canceled" or "aborted"? Write the word between quotes, then check."""

import rclpy
from rclpy.action import ActionServer
from rclpy.node import Node
from rover_interfaces.action import Charge

ANSWER = None


class Charger(Node):
    def __init__(self):
        super().__init__("charger")
        self.level = 20.0
        self.server = ActionServer(self, Charge, "charge", self.fill)

    def fill(self, goal_handle):
        while self.level < goal_handle.request.target:
            if self.level >= 60.0:  # the cable breaks
                goal_handle.abort()
                return Charge.Result(level=self.level)
            self.level += 10.0
        goal_handle.succeed()
        return Charge.Result(level=self.level)


def main():
    rclpy.init()
    rclpy.spin(Charger())


main()
