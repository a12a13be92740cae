"""Tell where frames are that never move."""

from __future__ import annotations

from typing import Any

from rclpy.qos import DurabilityPolicy, QoSProfile

from ._tf_message import tf_message
from .transform_broadcaster import TF_STATIC_TOPIC, as_list

KEPT = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class StaticTransformBroadcaster:
    """Publishes on /tf_static. The last message is kept for those who listen later."""

    def __init__(self, node: Any, qos: Any = None) -> None:
        """`qos` is a QoSProfile or a depth. Raises ImportError without tf2_msgs."""
        message = tf_message()
        self.pub_tf = node.create_publisher(message, TF_STATIC_TOPIC, KEPT if qos is None else qos)
        self.net_message = message()
        """All that was sent: who comes late hears one message, and misses nothing."""

    def sendTransform(self, transform: Any) -> None:  # noqa: N802  Jazzy's name
        """One TransformStamped, or several; a frame that was sent before lies as it does now."""
        told = {each.child_frame_id: each for each in self.net_message.transforms}
        told.update({each.child_frame_id: each for each in as_list(transform)})
        self.net_message.transforms = list(told.values())
        self.pub_tf.publish(self.net_message)
