"""A charger: a node called charger. It performs the action /charge, of the type
rover_interfaces/action/Charge. It begins at 20 percent, and goes up in steps of 10 with
a feedback after each. It ends with success, and with the level in its result."""

import rclpy
from rclpy.action import ActionServer
from rclpy.node import Node
from rover_interfaces.action import Charge


class Charger(Node):
    def __init__(self):
        super().__init__("charger")
        self.level = 20.0
        self.server = ActionServer(self, Charge, "charge", self.fill)

    def fill(self, goal_handle):
        while self.level < goal_handle.request.target:
            self.level += 10.0
            goal_handle.publish_feedback(Charge.Feedback(level=self.level))
        goal_handle.succeed()
        return Charge.Result(level=self.level)


def main():
    rclpy.init()
    rclpy.spin(Charger())


main()
