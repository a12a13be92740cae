"""A bridge: a node called bridge. It reads the board's port, and must hear /cmd_vel
at any time, also while the board is silent. (The port is a pipe in this program.)"""

import os
import threading

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node


class Bridge(Node):
    def __init__(self):
        super().__init__("bridge")
        self.port, self.board = os.pipe()
        self.create_subscription(Twist, "cmd_vel", self.drive, 10)
        threading.Thread(target=self.read_port, daemon=True).start()

    def read_port(self):
        while line := os.read(self.port, 100):
            print("the board says", line)

    def drive(self, order):
        os.write(self.board, b"M\n")


def main():
    rclpy.init()
    rclpy.spin(Bridge())


main()
