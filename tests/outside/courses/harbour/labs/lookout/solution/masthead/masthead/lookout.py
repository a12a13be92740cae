"""The lookout: it films the sea, in red, green and blue."""

import errno
import os
import socket

import rclpy
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import Image

WIDTH, HEIGHT, STEP = 640, 480, 1920
AS_IT_IS = 20
LEVELS = 3


class Lens:
    """A camera behind a socket: one picture for each letter that it gets."""

    def __init__(self, path):
        self.path = path
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.settimeout(5.0)
        try:
            self.socket.connect(path)
            number = self.receive(1)[0]
        except OSError as error:
            self.socket.close()
            raise self.trouble(error.errno or errno.ENODEV) from error
        if number:
            self.socket.close()
            raise self.trouble(number)

    def trouble(self, number):
        """Make an error with the system's words."""
        return OSError(number, os.strerror(number), self.path)

    def read(self):
        """Return the next picture: blue, green, red."""
        try:
            self.socket.sendall(b'.')
            return self.receive(STEP * HEIGHT)
        except OSError as error:
            raise self.trouble(errno.ENODEV) from error

    def receive(self, size):
        """Return exactly so many bytes."""
        content = bytearray()
        while len(content) < size:
            part = self.socket.recv(size - len(content))
            if not part:
                raise self.trouble(errno.ENODEV)
            content += part
        return content


class Lookout(Node):
    """Publishes each picture, lighter or darker."""

    def __init__(self):
        super().__init__('lookout')
        self.path = self.declare_parameter('lens', '/tmp/lens').value
        few = IntegerRange(from_value=0, to_value=40, step=1)
        limits = ParameterDescriptor(integer_range=[few])
        self.declare_parameter('light', AS_IT_IS, limits)
        self.publisher = self.create_publisher(Image, 'sea', 10)
        self.lens = None
        self.create_timer(0.1, self.film)
        self.create_timer(0.5, self.look)
        self.look()

    def look(self):
        """Open the lens, if it is not open."""
        if self.lens is None:
            try:
                self.lens = Lens(self.path)
            except OSError as error:
                self.get_logger().error(f'Blind: {error}')

    def film(self):
        """Publish the next picture."""
        if self.lens is None:
            return
        try:
            seen = self.lens.read()
        except OSError as error:
            self.get_logger().error(f'Blind: {error}')
            self.lens = None
            return
        self.publisher.publish(self.picture(self.lit(seen)))

    def lit(self, seen):
        """Add levels to each value, from 0 to 255."""
        more = (self.get_parameter('light').value - AS_IT_IS) * LEVELS
        table = bytes(min(255, max(0, value + more)) for value in range(256))
        return seen.translate(table)

    def picture(self, seen):
        """Put it into a message, red first."""
        seen[0::3], seen[2::3] = seen[2::3], seen[0::3]
        image = Image(height=HEIGHT, width=WIDTH, encoding='rgb8', step=STEP)
        image.header.stamp = self.get_clock().now().to_msg()
        image.header.frame_id = 'masthead'
        image.data = bytes(seen)
        return image


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Lookout())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
