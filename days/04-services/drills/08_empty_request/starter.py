"""Foretell: a client sends a new SetBool.Request() and fills in nothing. Which line is
written? Write it as a text, for example "heat maybe", then check."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import SetBool

ANSWER = None


class Heater(Node):
    def __init__(self):
        super().__init__("heater")
        self.create_service(SetBool, "heat", self.heat)

    def heat(self, request, response):
        print(f"heat {request.data}", flush=True)
        response.success = True
        return response


def main():
    rclpy.init()
    rclpy.spin(Heater())


main()
