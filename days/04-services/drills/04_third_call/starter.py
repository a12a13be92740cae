"""Foretell: /count is called three times. Which line is written at the third call?
Write it as a text, for example "count 0 steps 0", then check."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

ANSWER = None


class Counter(Node):
    def __init__(self):
        super().__init__("counter")
        self.calls = 0
        self.create_service(Trigger, "count", self.count)

    def count(self, request, response):
        steps = 0
        self.calls += 1
        steps += 1
        print(f"count {self.calls} steps {steps}", flush=True)
        response.success = True
        return response


def main():
    rclpy.init()
    rclpy.spin(Counter())


main()
