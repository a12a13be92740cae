"""Write a whole node, from the first line to the last.

It is called pump, and performs /fill (rover_interfaces/action/Charge). Its tank is
empty at first: 0 percent. It goes up in steps of 20 percent to the target, with a
feedback after each step, and ends with success and the level as its result.
The tank stays as full as it is: the next goal goes on from there.
"""

import rclpy
from rclpy.action import ActionServer
from rclpy.node import Node
from rover_interfaces.action import Charge


class Pump(Node):
    def __init__(self):
        super().__init__("pump")
        self.level = 0.0
        self.server = ActionServer(self, Charge, "fill", self.fill)

    def fill(self, goal_handle):
        while self.level < goal_handle.request.target:
            self.level += 20.0
            goal_handle.publish_feedback(Charge.Feedback(level=self.level))
        goal_handle.succeed()
        return Charge.Result(level=self.level)


def main():
    rclpy.init()
    rclpy.spin(Pump())


main()
