"""A link's messages, under the name that people know: to look at, never to drive by.

The rover's links have names of this run alone. `ros2 topic echo /rover/motors` shows what is said
there all the same: it is said again, as long as somebody listens.
"""

from __future__ import annotations

from typing import Any


class Mirror:
    """One link, said again."""

    def __init__(self, node: Any, shown: str, link: str) -> None:
        from geometry_msgs.msg import Twist

        self._node, self._kind, self._link = node, Twist, link
        self._publisher = node.create_publisher(Twist, shown, 10)
        self._subscription: Any = None

    def look(self) -> None:
        """Listen to the link, if anybody listens to us."""
        if not self._publisher.get_subscription_count():
            self._stop_listening()
        elif self._subscription is None:
            from rclpy.qos import qos_profile_sensor_data

            self._subscription = self._node.create_subscription(
                self._kind, self._link, self._publisher.publish, qos_profile_sensor_data
            )

    def close(self) -> None:
        """Say nothing more."""
        self._stop_listening()
        self._node.destroy_publisher(self._publisher)

    def _stop_listening(self) -> None:
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None
