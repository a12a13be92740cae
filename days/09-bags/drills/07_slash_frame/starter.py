"""A sonar: a node called sonar. Five times a second it tells on /distance what is
1.25 m in front of it. The robot's tree of frames knows the sonar as sonar_link."""

import rclpy
from rclpy.node import Node
from sensor_msgs.msg import Range


class Sonar(Node):
    def __init__(self):
        super().__init__("sonar")
        self.publisher = self.create_publisher(Range, "distance", 10)
        self.timer = self.create_timer(0.2, self.tell)

    def tell(self):
        echo = Range(range=1.25, min_range=0.02, max_range=4.0)
        echo.header.stamp = self.get_clock().now().to_msg()
        echo.header.frame_id = "/sonar_link"
        self.publisher.publish(echo)


def main():
    rclpy.init()
    rclpy.spin(Sonar())


main()
