"""Foretell: what does this program print? Write it between quotes, for example
"the speed is 0.5", then check."""

from pathlib import Path
from tempfile import mkdtemp

import rclpy
from rclpy.node import Node

ANSWER = "the speed is 0.3"

FILE = Path(mkdtemp(), "house.yaml")
FILE.write_text("""
/**:
  ros__parameters: {speed: 0.1}
/*/fan:
  ros__parameters: {speed: 0.2}
/south/**:
  ros__parameters: {speed: 0.3}
""")


class Fan(Node):
    def __init__(self):
        super().__init__("fan", namespace="/south/roof")
        self.declare_parameter("speed", 0.5)


def main():
    rclpy.init(args=["fan", "--ros-args", "--params-file", str(FILE)])
    print("the speed is", Fan().get_parameter("speed").value)


main()
