"""A mechanic: a node called mechanic. The engine sends its temperature on /engine,
at least once a second: that is the deadline that it offers. The mechanic must print
each one, e.g. "the engine has 80 degrees".

The drill runs the engine, too. By hand, start it in another terminal: python3 engine.py
"""

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import Int32


class Mechanic(Node):
    def __init__(self):
        super().__init__("mechanic")
        often = QoSProfile(depth=10, deadline=Duration(seconds=1.0))
        self.create_subscription(Int32, "engine", self.read, often)

    def read(self, degrees):
        print(f"the engine has {degrees.data} degrees")


def main():
    rclpy.init()
    rclpy.spin(Mechanic())


main()
