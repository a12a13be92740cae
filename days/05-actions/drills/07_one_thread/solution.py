"""A charger: a node called charger. It performs the action /charge, of the type
rover_interfaces/action/Charge, and stops when somebody cancels the goal."""

import rclpy
from rclpy.action import ActionServer, CancelResponse
from rclpy.node import Node
from rclpy.task import Future
from rover_interfaces.action import Charge


class Charger(Node):
    def __init__(self):
        super().__init__("charger")
        self.level = 20.0
        self.server = ActionServer(
            self, Charge, "charge", self.fill,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )
        self.tick = Future()
        self.create_timer(0.04, self.next_tick)

    def next_tick(self):
        tick, self.tick = self.tick, Future()
        tick.set_result(None)

    async def fill(self, goal_handle):
        while self.level < goal_handle.request.target:
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                return Charge.Result(level=self.level)
            await self.tick
            self.level += 2.0
            goal_handle.publish_feedback(Charge.Feedback(level=self.level))
        goal_handle.succeed()
        return Charge.Result(level=self.level)


def main():
    rclpy.init()
    rclpy.spin(Charger())


main()
