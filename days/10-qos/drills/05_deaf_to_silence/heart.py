"""The heart of this drill: four beats, once the nurse listens, and then none."""

import rclpy
from rclpy.duration import Duration
from rclpy.qos import QoSProfile
from std_msgs.msg import Int32

rclpy.init()
node = rclpy.create_node("heart")
promised = QoSProfile(depth=10, deadline=Duration(seconds=0.3))
publisher = node.create_publisher(Int32, "beat", promised)
beats = iter([1, 2, 3, 4])


def beat() -> None:
    """One beat more, as long as there are some."""
    ears = node.get_subscriptions_info_by_topic("/beat")
    if any(ear.node_name == "nurse" for ear in ears):
        for number in beats:
            publisher.publish(Int32(data=number))
            return


node.create_timer(0.1, beat)
rclpy.spin(node)
