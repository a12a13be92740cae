"""A nurse: a node called nurse. Beside it runs a heart, which beats a few times on
/beat and then stops. When no beat comes for 0.3 s, the nurse must print "no beat!".

The drill runs the heart, too. By hand, start it in another terminal: python3 heart.py
"""

import rclpy
from rclpy.duration import Duration
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import Int32


class Nurse(Node):
    def __init__(self):
        super().__init__("nurse")
        beat = QoSProfile(depth=10, deadline=Duration(seconds=0.3))
        events = SubscriptionEventCallbacks(deadline=self.alarm)
        self.create_subscription(Int32, "beat", self.hear, beat, event_callbacks=events)

    def hear(self, beat):
        print(f"beat {beat.data}")

    def alarm(self, event):
        print("no beat!")


def main():
    rclpy.init()
    rclpy.spin(Nurse())


main()
