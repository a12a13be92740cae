"""An asker: a node called asker. Twice a second it asks where the rover is now, and
waits for the answer. It prints "found", or "no answer" where none came in 0.3 s.

The drill runs the rover, too. By hand, start it in another terminal: python3 driver.py
"""

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from tf2_ros import Buffer, TransformListener


class Asker(Node):
    def __init__(self):
        super().__init__("asker")
        self.buffer = Buffer(node=self)
        self.listener = TransformListener(self.buffer, self)
        self.create_timer(0.5, self.ask)

    def ask(self):
        now, wait = self.get_clock().now(), Duration(seconds=0.3)
        there = self.buffer.can_transform("odom", "base_link", now, wait)
        print("found" if there else "no answer", flush=True)


def main():
    rclpy.init()
    rclpy.spin(Asker())


main()
