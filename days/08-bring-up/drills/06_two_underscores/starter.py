"""A fan that is started with a parameter file. It must print "the speed is 1.5"."""

from pathlib import Path
from tempfile import mkdtemp

import rclpy
from rclpy.node import Node

FILE = Path(mkdtemp(), "fan.yaml")
FILE.write_text("""
/fan:
  ros_parameters:
    speed: 1.5
""")


class Fan(Node):
    def __init__(self):
        super().__init__("fan")
        self.declare_parameter("speed", 0.5)


def main():
    rclpy.init(args=["fan", "--ros-args", "--params-file", str(FILE)])
    print("the speed is", Fan().get_parameter("speed").value)


main()
