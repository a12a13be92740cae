"""An arm: a node called arm. It serves /fold (std_srvs/srv/Trigger), and answers
success True and the message "folded"."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Empty


class Arm(Node):
    def __init__(self):
        super().__init__("arm")
        self.create_service(Empty, "fold", self.fold)

    def fold(self, request, response):
        return response


def main():
    rclpy.init()
    rclpy.spin(Arm())


main()
