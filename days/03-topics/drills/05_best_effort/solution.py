"""A sonar: a node called sonar. It publishes on /echo, 10 times a second.

Who listens there asks for reliable delivery - and hears nothing.
"""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32


class Sonar(Node):
    def __init__(self):
        super().__init__("sonar")
        self.publisher = self.create_publisher(Float32, "echo", 10)
        self.timer = self.create_timer(0.1, self.tell)

    def tell(self):
        self.publisher.publish(Float32(data=0.42))


def main():
    rclpy.init()
    rclpy.spin(Sonar())


main()
