"""A viewer: a node called viewer. It listens to a camera on /image. The camera
publishes with the quality of service of sensors: best effort."""

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data  # noqa: F401
from sensor_msgs.msg import Image


class Viewer(Node):
    def __init__(self):
        super().__init__("viewer")
        self.create_subscription(Image, "image", self.look, 10)

    def look(self, picture):
        print(f"a picture of {picture.width} x {picture.height}")


def main():
    rclpy.init()
    rclpy.spin(Viewer())


main()
