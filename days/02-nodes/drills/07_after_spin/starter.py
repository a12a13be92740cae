"""The rover's horn: a node called horn. It says "honk 0", "honk 1", ...
on /horn, 5 times a second."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Horn(Node):
    count = 0

    def begin(self):
        self.publisher = self.create_publisher(String, "horn", 10)
        self.timer = self.create_timer(0.2, self.honk)

    def honk(self):
        self.publisher.publish(String(data=f"honk {self.count}"))
        self.count += 1


def main():
    rclpy.init()
    horn = Horn("horn")
    rclpy.spin(horn)
    horn.begin()


main()
