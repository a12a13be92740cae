"""A fan whose speed goes from 0.0 to 2.0. Write its range: 1.5 is good, 5.0 is not.

It must print "1.5 True", "5.0 False" and "the speed is 1.5".
"""

import rclpy
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter


class Fan(Node):
    def __init__(self):
        super().__init__("fan")
        about = ParameterDescriptor(description="turns a second")
        about.floating_point_range = [FloatingPointRange(from_value=0.0, to_value=2.0)]
        self.declare_parameter("speed", 0.5, about)


def main():
    rclpy.init()
    fan = Fan()
    for speed in (1.5, 5.0):
        (result,) = fan.set_parameters([Parameter("speed", value=speed)])
        print(speed, result.successful)
    print("the speed is", fan.get_parameter("speed").value)


main()
