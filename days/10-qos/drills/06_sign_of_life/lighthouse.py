"""The lighthouse of this drill: one message, some signs of life, and then none."""

import rclpy
from rclpy.duration import Duration
from rclpy.qos import LivelinessPolicy, QoSProfile
from std_msgs.msg import Bool

rclpy.init()
node = rclpy.create_node("lighthouse")
alive = QoSProfile(
    depth=1,
    liveliness=LivelinessPolicy.MANUAL_BY_TOPIC,
    liveliness_lease_duration=Duration(seconds=0.5),
)
publisher = node.create_publisher(Bool, "lamp", alive)
signs = iter(range(6))


def give_a_sign() -> None:
    """The first is a message; after the last one it sleeps, and its program runs on."""
    ears = node.get_subscriptions_info_by_topic("/lamp")
    if any(ear.node_name == "keeper" for ear in ears):
        for sign in signs:
            if sign == 0:
                publisher.publish(Bool(data=True))
            publisher.assert_liveliness()
            return


node.create_timer(0.1, give_a_sign)
rclpy.spin(node)
