"""A lamp: a node called lamp. It serves /lamp/switch (std_srvs/srv/SetBool). It
answers success True, and the message "on" or "off"."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import SetBool


class Lamp(Node):
    def __init__(self):
        super().__init__("lamp")
        self.create_service(SetBool, "lamp/switsh", self.switch)

    def switch(self, request, response):
        response.success = True
        response.message = "on" if request.data else "off"
        return response


def main():
    rclpy.init()
    rclpy.spin(Lamp())


main()
