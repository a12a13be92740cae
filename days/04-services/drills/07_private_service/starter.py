"""A motor: a node called motor. It serves /reset (std_srvs/srv/Trigger), and answers
success True and the message "zero"."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Motor(Node):
    def __init__(self):
        super().__init__("motor")
        self.create_service(Trigger, "~/reset", self.reset)

    def reset(self, request, response):
        response.success = True
        response.message = "zero"
        return response


def main():
    rclpy.init()
    rclpy.spin(Motor())


main()
