"""A lamp that says on its topic light whether it is on, 5 times a second.

There are two of it. This one is started in the namespace /left:
    python3 FILE --ros-args -r __ns:=/left
So its topic must be /left/light.
"""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool


class Lamp(Node):
    def __init__(self):
        super().__init__("lamp")
        self.light = self.create_publisher(Bool, "light", 10)
        self.timer = self.create_timer(0.2, self.tell)

    def tell(self):
        self.light.publish(Bool(data=True))


def main():
    rclpy.init()
    rclpy.spin(Lamp())


main()
