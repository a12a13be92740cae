"""The camera: publishes what it sees, lighter or darker."""

import cv2
import rclpy
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image

from pi_camera.devices import open_camera

NEUTRAL = 50
LEVELS = 2.55  # for each point of brightness


class Camera(Node):
    """Reads one camera at a steady rate, and publishes each picture."""

    def __init__(self):
        super().__init__('camera')
        self.device = self.declare_parameter('device', '/tmp/rover_camera').value
        whole = IntegerRange(from_value=0, to_value=100, step=1)
        limits = ParameterDescriptor(integer_range=[whole])
        self.declare_parameter('brightness', NEUTRAL, limits)
        self.publisher = self.create_publisher(
            Image, 'camera/image_raw', qos_profile_sensor_data
        )
        self.camera = None
        self.create_timer(1 / 15, self.take_picture)
        self.create_timer(0.5, self.connect)
        self.connect()

    def connect(self):
        """Open the camera, if it is not open; called again and again."""
        if self.camera is not None:
            return
        try:
            self.camera = open_camera(self.device)
        except OSError as error:
            self.get_logger().error(f'No camera: {error}')
            return
        self.get_logger().info(f'The camera is {self.device}')

    def take_picture(self):
        """Publish the next picture."""
        if self.camera is None:
            return
        try:
            picture = self.camera.read()
        except OSError as error:
            self.get_logger().error(f'No camera: {error}')
            self.camera.close()
            self.camera = None
            return
        stamp = self.get_clock().now().to_msg()
        self.publisher.publish(self.message(self.lit(picture), stamp))

    def lit(self, picture):
        """Make the picture lighter or darker, as the parameter says now."""
        points = self.get_parameter('brightness').value - NEUTRAL
        levels = round(points * LEVELS)
        return cv2.add(picture, (levels, levels, levels, 0)) if levels else picture

    def message(self, picture, stamp):
        """Put a picture into a message."""
        height, width, channels = picture.shape
        image = Image(height=height, width=width, encoding='bgr8')
        image.header.stamp = stamp
        image.header.frame_id = 'camera_optical'
        image.step = width * channels
        image.data = picture.tobytes()  # a list would be 300 times slower
        return image


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Camera())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
