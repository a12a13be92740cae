"""Write a whole node, from the first line to the last.

It is called odometer. On /ticks (std_msgs/msg/Int32) it hears how many ticks a wheel
has made. For each message it publishes the way in metres on /metres, as
std_msgs/msg/Float64.
A turn has 360 ticks, and takes the rover 0.2 m along.
"""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64, Int32


class Odometer(Node):
    def __init__(self):
        super().__init__("odometer")
        self.publisher = self.create_publisher(Float64, "metres", 10)
        self.create_subscription(Int32, "ticks", self.count, 10)

    def count(self, ticks):
        self.publisher.publish(Float64(data=ticks.data / 360 * 0.2))


def main():
    rclpy.init()
    rclpy.spin(Odometer())


main()
