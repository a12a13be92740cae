"""A heating that goes on below low and off above high. In winter it shall be 26 to 30.

It must print "from 26.0 to 30.0". The rule in judge is right, leave it as it is.
"""

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter


class Heating(Node):
    def __init__(self):
        super().__init__("heating")
        self.declare_parameter("low", 18.0)
        self.declare_parameter("high", 24.0)
        self.add_on_set_parameters_callback(self.judge)

    def judge(self, wanted):
        now = {name: self.get_parameter(name).value for name in ("low", "high")}
        now.update((each.name, each.value) for each in wanted)
        return SetParametersResult(successful=now["low"] < now["high"])


def main():
    rclpy.init()
    heating = Heating()
    winter = [Parameter("low", value=26.0), Parameter("high", value=30.0)]
    heating.set_parameters(winter)
    low, high = (heating.get_parameter(name).value for name in ("low", "high"))
    print(f"from {low} to {high}")


main()
