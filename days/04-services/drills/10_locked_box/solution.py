"""Write a whole node, from the first line to the last.

It is called box. It serves /lock (std_srvs/srv/SetBool), and is open at first. With
data true it locks itself, with false it opens: success True, message "locked" or
"open". Where it is so already: success False, message "nothing changed".
"""

import rclpy
from rclpy.node import Node
from std_srvs.srv import SetBool


class Box(Node):
    def __init__(self):
        super().__init__("box")
        self.locked = False
        self.create_service(SetBool, "lock", self.lock)

    def lock(self, request, response):
        response.success = request.data != self.locked
        self.locked = request.data
        response.message = "locked" if self.locked else "open"
        if not response.success:
            response.message = "nothing changed"
        return response


def main():
    rclpy.init()
    rclpy.spin(Box())


main()
