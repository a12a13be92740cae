"""A painter: a node called painter. A laser turns, and tells on /nail where it saw a
nail, in its own frame. For each message, print where the nail is in odom:
"nail at 1.00, 1.00".

The drill runs the laser, too. By hand, start it in another terminal: python3 turner.py
"""

import rclpy
from geometry_msgs.msg import PointStamped
from rclpy.node import Node
from rclpy.time import Time
from tf2_geometry_msgs import do_transform_point
from tf2_ros import Buffer, TransformException, TransformListener


class Painter(Node):
    def __init__(self):
        super().__init__("painter")
        self.buffer = Buffer(node=self)
        self.listener = TransformListener(self.buffer, self)
        self.create_subscription(PointStamped, "nail", self.paint, 10)

    def paint(self, nail):
        time = Time()
        try:
            transform = self.buffer.lookup_transform("odom", "laser", time)
        except TransformException:
            return  # the first ones are older than all that was heard
        place = do_transform_point(nail, transform).point
        print(f"nail at {place.x:.2f}, {place.y:.2f}", flush=True)


def main():
    rclpy.init()
    rclpy.spin(Painter())


main()
