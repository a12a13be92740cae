"""A heart whose beat is a parameter: period, in seconds. It is started like this:

    python3 FILE --ros-args -p period:=0.1

Then it must say "beat 0", "beat 1", ... on /heartbeat, 10 times a second.
"""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Heart(Node):
    def __init__(self):
        super().__init__("heart")
        self.declare_parameter("period", 1.0)
        period = self.get_parameter("period").value
        self.count = 0
        self.publisher = self.create_publisher(String, "heartbeat", 10)
        self.timer = self.create_timer(period, self.beat)

    def beat(self):
        self.publisher.publish(String(data=f"beat {self.count}"))
        self.count += 1


def main():
    rclpy.init()
    rclpy.spin(Heart())


main()
