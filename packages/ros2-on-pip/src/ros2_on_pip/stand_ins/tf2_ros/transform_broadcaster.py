"""Tell where frames are that move."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ._tf_message import tf_message

TF_TOPIC, TF_STATIC_TOPIC = "/tf", "/tf_static"
DEPTH = 100


class TransformBroadcaster:
    """Publishes on /tf. A step is heard by those that listen now, so send it again and again."""

    def __init__(self, node: Any, qos: Any = None) -> None:
        """`qos` is a QoSProfile or a depth; 100 by default. Raises ImportError without tf2_msgs."""
        self._message = tf_message()
        self.pub_tf = node.create_publisher(self._message, TF_TOPIC, DEPTH if qos is None else qos)

    def sendTransform(self, transform: Any) -> None:  # noqa: N802  Jazzy's name
        """One TransformStamped, or several, in one message."""
        self.pub_tf.publish(self._message(transforms=as_list(transform)))


def as_list(transform: Any) -> list[Any]:
    """One TransformStamped or several, as a list."""
    return list(transform) if isinstance(transform, Iterable) else [transform]
