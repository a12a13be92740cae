"""The camera: publishes what it sees, lighter or darker.

Do the TODOs in the order of their numbers. The names and numbers that you need
stand on the card, in labs/pi-camera/task.md.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

# TODO 3: import cv2, open_camera from pi_camera.devices, the message type of the
#         card, and qos_profile_sensor_data from rclpy.qos. A parameter with limits
#         needs ParameterDescriptor and IntegerRange from rcl_interfaces.msg.


class Camera(Node):
    """Reads one camera at a steady rate, and publishes each picture."""

    def __init__(self):
        # TODO 4: give the node the name from the card, without the slash.
        super().__init__('change_me')
        # TODO 5: declare the two parameters. ROS refuses wrong values for you, when
        #         you give limits as the third argument of declare_parameter:
        #         ParameterDescriptor(integer_range=[IntegerRange(from_value=...,
        #         to_value=..., step=1)])
        # TODO 6: create the publisher, with the QoS of the card, and two timers:
        #         one takes a picture, at the card's rate; one opens the camera
        #         when it is not open, twice a second.
        self.camera = None

    def connect(self):
        """Open the camera, if it is not open; called again and again."""
        # TODO 7: open it with open_camera. An OSError says why that cannot be done:
        #         log the line of the card, and try again at the next call.

    def take_picture(self):
        """Publish the next picture."""
        # TODO 8: read one picture. An OSError means that the camera is gone: log
        #         the line of the card, close it, and let connect open it again.
        #         Then make the picture lighter or darker. cv2.add stops at 0 and
        #         at 255; plain + goes round, from 255 to 0.

    def message(self, picture, stamp):
        """Put a picture into a message."""
        # TODO 9: fill the fields that the card names, and the stamp. The bytes go
        #         into data: picture.tobytes() is quick, a list of numbers is slow.


def main(args=None):
    """Run the node until Ctrl-C."""
    # This part is complete. You need it again in ball_finder.py.
    try:
        rclpy.init(args=args)
        rclpy.spin(Camera())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
