"""A gate: a node called gate. It serves /gate (std_srvs/srv/SetBool). For true it
answers "open", for false "shut", and success True for both."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import SetBool


class Gate(Node):
    def __init__(self):
        super().__init__("gate")
        self.create_service(SetBool, "gate", self.move)

    def move(self, request, response):
        response.success = True
        if request:
            response.message = "open"
        else:
            response.message = "shut"
        return response


def main():
    rclpy.init()
    rclpy.spin(Gate())


main()
