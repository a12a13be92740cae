"""The rover's horn: a node called horn. It serves /honk (std_srvs/srv/Trigger), and
answers success True and the message "honk"."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Horn(Node):
    def __init__(self):
        super().__init__("horn")
        self.create_service(Trigger, "honk", self.honk)

    def honk(self, request, response):
        response.success = True
        response.message = "honk"
        return response


def main():
    rclpy.init()
    rclpy.spin(Horn())


main()
