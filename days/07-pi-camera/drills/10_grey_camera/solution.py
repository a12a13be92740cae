"""Write a whole node, from the first line to the last.

It is called grey_camera. On /grey (sensor_msgs/msg/Image) it publishes a black
picture, 10 times a second: 4 pixels wide, 2 high, encoding mono8. Its header names the
frame mast.
"""

import rclpy
from rclpy.node import Node
from sensor_msgs.msg import Image


class GreyCamera(Node):
    def __init__(self):
        super().__init__("grey_camera")
        self.publisher = self.create_publisher(Image, "grey", 10)
        self.timer = self.create_timer(0.1, self.tell)

    def tell(self):
        picture = Image(height=2, width=4, encoding="mono8", step=4, data=bytes(8))
        picture.header.frame_id = "mast"
        picture.header.stamp = self.get_clock().now().to_msg()
        self.publisher.publish(picture)


def main():
    rclpy.init()
    rclpy.spin(GreyCamera())


main()
