"""The ball finder: says where in each picture the ball is."""

import cv2
import numpy
import rclpy
from geometry_msgs.msg import PointStamped
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image

CHANNELS = {'bgr8': 3, 'rgb8': 3, 'mono8': 1}
TO_BGR = {'rgb8': cv2.COLOR_RGB2BGR, 'mono8': cv2.COLOR_GRAY2BGR}
HUES = 180
HUE_WINDOW = 10
LEAST_SATURATION = 90
LEAST_VALUE = 40
LEAST_RADIUS = 5.0
GREEN = (0, 255, 0)


def picture_of(image):
    """Turn a message into an OpenCV picture; raise ValueError where it cannot be."""
    channels = CHANNELS.get(image.encoding)
    if channels is None:
        raise ValueError(f'its encoding is {image.encoding!r}')
    needed = image.step * image.height
    if not image.width or not image.height or image.step < image.width * channels:
        raise ValueError(f'it has {image.width} columns in rows of {image.step} bytes')
    if len(image.data) < needed:
        raise ValueError(f'it has {len(image.data)} bytes and needs {needed}')
    rows = numpy.frombuffer(image.data, numpy.uint8, needed)
    rows = rows.reshape(image.height, image.step)[:, : image.width * channels]
    picture = rows.reshape(image.height, image.width, channels)
    conversion = TO_BGR.get(image.encoding)
    return picture.copy() if conversion is None else cv2.cvtColor(picture, conversion)


def find_ball(picture, wanted_hue):
    """Return column, row and radius of the largest ball of this hue, or None."""
    calm = cv2.GaussianBlur(picture, (3, 3), 0)
    hue, saturation, value = cv2.split(cv2.cvtColor(calm, cv2.COLOR_BGR2HSV))
    away = numpy.abs(hue.astype(numpy.int16) - wanted_hue)
    away = numpy.minimum(away, HUES - away)  # the wheel is round
    bright = (saturation >= LEAST_SATURATION) & (value >= LEAST_VALUE)
    mask = ((away <= HUE_WINDOW) & bright).astype(numpy.uint8)
    mask = cv2.morphologyEx(mask, cv2.MORPH_OPEN, numpy.ones((5, 5), numpy.uint8))
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    if not contours:
        return None
    (x, y), radius = cv2.minEnclosingCircle(max(contours, key=cv2.contourArea))
    return (x, y, radius) if radius >= LEAST_RADIUS else None


class BallFinder(Node):
    """Looks for one ball in each picture."""

    def __init__(self):
        super().__init__('ball_finder')
        whole = IntegerRange(from_value=0, to_value=HUES - 1, step=1)
        limits = ParameterDescriptor(integer_range=[whole])
        self.declare_parameter('ball_hue', 5, limits)
        self.ball_publisher = self.create_publisher(PointStamped, 'ball', 10)
        self.image_publisher = self.create_publisher(Image, 'ball/image', 10)
        self.create_subscription(
            Image, 'camera/image_raw', self.look, qos_profile_sensor_data
        )

    def look(self, image):
        """Say where the ball is in this picture."""
        try:
            picture = picture_of(image)
        except ValueError as error:
            self.get_logger().warning(f'Bad picture: {error}')
            return
        ball = find_ball(picture, self.get_parameter('ball_hue').value)
        if ball is not None:
            x, y, radius = ball
            point = PointStamped(header=image.header)
            point.point.x, point.point.y = float(x), float(y)
            self.ball_publisher.publish(point)
            cv2.circle(picture, (round(x), round(y)), round(radius) + 3, GREEN, 2)
        self.image_publisher.publish(self.message(picture, image.header))

    def message(self, picture, header):
        """Put an OpenCV picture into a message, with the header of the first one."""
        height, width, channels = picture.shape
        image = Image(header=header, height=height, width=width, encoding='bgr8')
        image.step = width * channels
        image.data = picture.tobytes()
        return image


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(BallFinder())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
