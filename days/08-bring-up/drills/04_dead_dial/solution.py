"""A lamp whose brightness is a parameter. Somebody sets it to 80 while the lamp is on.

It must print "it shines with 80 percent". Leave main as it is.
"""

import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter


class Lamp(Node):
    def __init__(self):
        super().__init__("lamp")
        self.declare_parameter("percent", 20)

    def shine(self):
        percent = self.get_parameter("percent").value
        print(f"it shines with {percent} percent")


def main():
    rclpy.init()
    lamp = Lamp()
    lamp.set_parameters([Parameter("percent", value=80)])
    lamp.shine()


main()
