"""A keeper: a node called keeper. Beside it runs a lighthouse, which says on /lamp
that it is lit, once, and later falls asleep. While it is awake, it gives a sign of life
at least every 0.5 s. Without one, the keeper must print "the lamp is lost".

The drill runs the lighthouse, too. By hand, start it in another terminal:
python3 lighthouse.py
"""

import rclpy
from rclpy.duration import Duration
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import LivelinessPolicy, QoSProfile
from std_msgs.msg import Bool

ALIVE = QoSProfile(
    depth=1,
    liveliness=LivelinessPolicy.MANUAL_BY_TOPIC,
    liveliness_lease_duration=Duration(seconds=0.5),
)


class Keeper(Node):
    def __init__(self):
        super().__init__("keeper")
        events = SubscriptionEventCallbacks(deadline=self.look)
        self.create_subscription(Bool, "lamp", self.see, ALIVE, event_callbacks=events)

    def see(self, lamp):
        print("the lamp is lit" if lamp.data else "the lamp is dark")

    def look(self, event):
        if event.alive_count == 0:
            print("the lamp is lost")


def main():
    rclpy.init()
    rclpy.spin(Keeper())


main()
