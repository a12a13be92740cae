"""A sensor in the cellar: a node called cellar. It reads 45 percent, and tells it on
/air as sensor_msgs/msg/RelativeHumidity, 5 times a second."""

import rclpy
from rclpy.node import Node
from sensor_msgs.msg import RelativeHumidity

PERCENT = 45.0


class Cellar(Node):
    def __init__(self):
        super().__init__("cellar")
        self.publisher = self.create_publisher(RelativeHumidity, "air", 10)
        self.timer = self.create_timer(0.2, self.tell)

    def tell(self):
        report = RelativeHumidity()
        report.header.frame_id = "cellar"
        report.header.stamp = self.get_clock().now().to_msg()
        report.relative_humidity = PERCENT
        self.publisher.publish(report)


def main():
    rclpy.init()
    rclpy.spin(Cellar())


main()
