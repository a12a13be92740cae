"""The ball finder: says where in each picture the ball is.

Do the TODOs in the order of their numbers, after those of camera.py.
"""

from rclpy.node import Node

# TODO 10: import what you need: cv2, numpy, the two message types, and what
#          camera.py imports from rclpy and from rcl_interfaces.


def picture_of(image):
    """Turn a message into an OpenCV picture; raise ValueError where it cannot be."""
    # TODO 11: compare len(image.data) with what the header says: step x height.
    #          Are there too few bytes, or is the encoding none that you know?
    #          Then raise ValueError, with a text that says so.
    # TODO 12: numpy.frombuffer(image.data, numpy.uint8) gives all bytes. Make rows
    #          of "step" bytes, cut the idle bytes off, and only then make columns.
    # TODO 13: turn rgb8 and mono8 into bgr8, with cv2.cvtColor.
    return None


def find_ball(picture, wanted_hue):
    """Return column, row and radius of the largest ball of this hue, or None."""
    # TODO 14: turn the picture into hue, saturation and value (COLOR_BGR2HSV). Make
    #          a mask of the points whose hue is near to the wanted one and that are
    #          no grey. Think of the end of the wheel: 179 and 1 are near.
    # TODO 15: take small dots out of the mask (cv2.morphologyEx, MORPH_OPEN), find
    #          the outlines (cv2.findContours), and put a circle around the largest
    #          one (cv2.minEnclosingCircle). Is it too small? Then it is no ball.
    return None


class BallFinder(Node):
    """Looks for one ball in each picture."""

    def __init__(self):
        # TODO 16: name, parameter, two publishers, one subscription.
        super().__init__('change_me')

    def look(self, image):
        """Say where the ball is in this picture."""
        # TODO 17: a bad picture is logged, with the line of the card, and no more.
        #          For a ball, publish the point, with the header of the picture.
        #          The numbers in it must be Python floats.
        # TODO 18: draw a ring around the ball (cv2.circle), and publish the picture,
        #          with the header of the first one. Without a ball, publish it too.


# TODO 19: write main, as in camera.py.
