"""A camera: a node called camera. It publishes an empty picture on /image
(sensor_msgs/msg/Image), 5 times a second."""

import rclpy
from rclpy.node import Node
from sensor_msgs.msg import Image


class Camera(Node):
    def __init__(self):
        super().__init__("camera")
        self.publisher = self.create_publisher(Image, "~/image", 10)
        self.timer = self.create_timer(0.2, self.tell)

    def tell(self):
        self.publisher.publish(Image())


def main():
    rclpy.init()
    rclpy.spin(Camera())


main()
