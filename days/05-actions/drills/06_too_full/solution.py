"""A charger: a node called charger. It performs the action /charge, of the type
rover_interfaces/action/Charge. It must refuse each target above 100 percent, and take
all others."""

import rclpy
from rclpy.action import ActionServer, GoalResponse
from rclpy.node import Node
from rover_interfaces.action import Charge


class Charger(Node):
    def __init__(self):
        super().__init__("charger")
        self.server = ActionServer(
            self, Charge, "charge", self.fill, goal_callback=self.judge
        )

    def judge(self, goal):
        if goal.target > 100.0:
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def fill(self, goal_handle):
        goal_handle.succeed()
        return Charge.Result(level=goal_handle.request.target)


def main():
    rclpy.init()
    rclpy.spin(Charger())


main()
