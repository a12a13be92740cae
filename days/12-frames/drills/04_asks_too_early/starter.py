"""A finder: a node called finder. It looks up where the laser sits on the rover, and
prints how far ahead: "laser at 0.20 m". While nobody has told of it, the node waits.

The drill runs the frames, too. By hand, start them in another terminal:
python3 frames.py
"""

import rclpy
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformListener


class Finder(Node):
    def __init__(self):
        super().__init__("finder")
        self.buffer = Buffer(node=self)
        self.listener = TransformListener(self.buffer, self)
        self.find()

    def find(self):
        found = self.buffer.lookup_transform("base_link", "laser", Time())
        print(f"laser at {found.transform.translation.x:.2f} m", flush=True)


def main():
    rclpy.init()
    rclpy.spin(Finder())


main()
