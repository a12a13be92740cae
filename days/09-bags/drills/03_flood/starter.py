"""A thermometer: a node called thermometer. It tells its temperature on /temperature
each 200 milliseconds, as sensor_msgs/msg/Temperature."""

import rclpy
from rclpy.node import Node
from sensor_msgs.msg import Temperature

PERIOD_S = 0.02


class Thermometer(Node):
    def __init__(self):
        super().__init__("thermometer")
        self.publisher = self.create_publisher(Temperature, "temperature", 10)
        self.timer = self.create_timer(PERIOD_S, self.tell)

    def tell(self):
        report = Temperature(temperature=21.5)
        report.header.stamp = self.get_clock().now().to_msg()
        report.header.frame_id = "yard"
        self.publisher.publish(report)


def main():
    rclpy.init()
    rclpy.spin(Thermometer())


main()
