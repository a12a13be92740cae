"""A gate that opens by 0 to 100 percent. 40 must be taken, 140 refused.

It must print "it is open by 40".
"""

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter


class Gate(Node):
    def __init__(self):
        super().__init__("gate")
        self.declare_parameter("percent", 0)
        self.add_on_set_parameters_callback(self.judge)

    def judge(self, wanted):
        if any(each.value > 100 for each in wanted):
            return SetParametersResult(successful=False, reason="more than all")
        return SetParametersResult(successful=True)


def main():
    rclpy.init()
    gate = Gate()
    for percent in (40, 140):
        gate.set_parameters([Parameter("percent", value=percent)])
    print("it is open by", gate.get_parameter("percent").value)


main()
