"""Hear where frames are."""

from __future__ import annotations

from contextlib import suppress
from threading import Thread
from typing import Any

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile

from ._tf_message import tf_message
from .transform_broadcaster import DEPTH, TF_STATIC_TOPIC, TF_TOPIC

DEFAULT_TF_TOPIC, DEFAULT_STATIC_TF_TOPIC = TF_TOPIC, TF_STATIC_TOPIC
KEPT = QoSProfile(depth=DEPTH, durability=DurabilityPolicy.TRANSIENT_LOCAL)
AUTHORITY = "default_authority"
"""Nobody knows who published a message; so it stands in geometry2, too."""


class TransformListener:
    """Subscribes to /tf and /tf_static, and fills a buffer.

    The node holds the subscriptions, and they hold the listener: it goes on hearing when nothing
    else has a name for it. Its callbacks run when the node spins. A look-up that waits in another
    callback of one thread waits in vain, unless the listener has its own (`spin_thread`).
    """

    def __init__(
        self,
        buffer: Any,
        node: Any,
        *,
        spin_thread: bool = False,
        qos: Any = None,
        static_qos: Any = None,
    ) -> None:
        """Raises ImportError without tf2_msgs."""
        message = tf_message()
        self.buffer, self.node = buffer, node
        self.group = ReentrantCallbackGroup()
        self.tf_sub = node.create_subscription(
            message,
            TF_TOPIC,
            self.callback,
            DEPTH if qos is None else qos,
            callback_group=self.group,
        )
        self.tf_static_sub = node.create_subscription(
            message,
            TF_STATIC_TOPIC,
            self.static_callback,
            KEPT if static_qos is None else static_qos,
            callback_group=self.group,
        )
        if spin_thread:
            self._spin_alone()

    def _spin_alone(self) -> None:
        # A daemon: it hears until the context ends, and keeps no program from ending.
        self.executor = SingleThreadedExecutor(context=self.node.context)
        self.executor.add_node(self.node)
        self.dedicated_listener_thread = Thread(target=self._spin, daemon=True)
        self.dedicated_listener_thread.start()

    def _spin(self) -> None:
        with suppress(ExternalShutdownException):
            self.executor.spin()

    def unregister(self) -> None:
        """Hear nothing any more."""
        if hasattr(self, "executor"):
            self.executor.shutdown()
            self.dedicated_listener_thread.join()
        self.node.destroy_subscription(self.tf_sub)
        self.node.destroy_subscription(self.tf_static_sub)

    def callback(self, data: Any) -> None:
        """Of /tf."""
        for transform in data.transforms:
            self.buffer.set_transform(transform, AUTHORITY)

    def static_callback(self, data: Any) -> None:
        """Of /tf_static."""
        for transform in data.transforms:
            self.buffer.set_transform_static(transform, AUTHORITY)
