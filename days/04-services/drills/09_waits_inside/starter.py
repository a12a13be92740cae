"""A porter: a node called porter. It calls /gate (std_srvs/srv/SetBool) with data True,
once, from its timer. It writes "The gate says: " and the answer's message."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import SetBool


class Porter(Node):
    def __init__(self):
        super().__init__("porter")
        self.gate = self.create_client(SetBool, "gate")
        self.timer = self.create_timer(0.1, self.ask)

    def ask(self):
        if not self.gate.service_is_ready():
            return
        self.timer.cancel()
        response = self.gate.call(SetBool.Request(data=True))
        self.tell(response)

    def tell(self, response):
        print(f"The gate says: {response.message}", flush=True)


def main():
    rclpy.init()
    rclpy.spin(Porter())


main()
