"""The second of a chain: the nearest distance in, commands out, by a timer too."""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Float32


class Pilot(Node):
    """Says the newest command again and again."""

    def __init__(self) -> None:
        super().__init__("pilot")
        self.command = Twist()
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Float32, "nearest", self.hear, 10)
        self.create_timer(0.15, lambda: self.publisher.publish(self.command))

    def hear(self, near: Float32) -> None:
        """Slower where something is near."""
        self.command = Twist()
        self.command.linear.x = min(0.3, max(0.0, (near.data - 0.4) / 3))
        self.command.angular.z = 0.3 if near.data < 1.0 else 0.05
        self.publisher.publish(self.command)


rclpy.init()
rclpy.spin(Pilot())
