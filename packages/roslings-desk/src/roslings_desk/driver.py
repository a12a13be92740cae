"""Drives what listens on a topic of Twist, and stops it when nobody says any more to go on.

Whoever drives says so again and again. That ends where the page was closed, the computer sleeps or
the network is gone. Then a zero Twist is published after `LASTS_S`, by a timer of the node. Neither
the browser nor the server of the page has a part in it.
"""

from __future__ import annotations

import threading
import time
from types import TracebackType

from roslings_desk.hub import Hub

LASTS_S = 0.6
EVERY_S = 0.1
ACKED_WITHIN_S = 0.5


class TwistPublisher:
    """A publisher of geometry_msgs/msg/Twist. A context manager: leaving the block stops first."""

    def __init__(self, hub: Hub, topic: str) -> None:
        self._hub, self._topic = hub, topic
        self._lock = threading.Lock()
        self._forward_m_s = self._turn_rad_s = 0.0
        self._until_s = 0.0
        self.driving = False

    def __enter__(self) -> TwistPublisher:
        self._opened = self._hub.do(self._open)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._hub.do(self._close)

    def _open(self) -> None:
        from geometry_msgs.msg import Twist

        self._make = Twist
        self._publisher = self._hub.desk_node.node.create_publisher(Twist, self._topic, 10)
        self._timer = self._hub.desk_node.node.create_timer(EVERY_S, self._go_on)

    def _close(self) -> None:
        from rclpy.duration import Duration

        self._opened.result()
        self._hub.desk_node.node.destroy_timer(self._timer)
        if self.driving:
            self._end()
            self._publisher.wait_for_all_acked(Duration(seconds=ACKED_WITHIN_S))
        self._hub.desk_node.node.destroy_publisher(self._publisher)

    @property
    def listeners(self) -> int:
        """How many subscriptions hear what is published."""
        if not self._opened.done():
            return 0
        return int(self._publisher.get_subscription_count())

    def drive(self, forward_m_s: float, turn_rad_s: float, for_s: float = LASTS_S) -> None:
        """Go so from now on, and stop after `for_s` where nothing else is said."""
        with self._lock:
            self._forward_m_s, self._turn_rad_s = forward_m_s, turn_rad_s
            self._until_s = time.monotonic() + for_s
            self.driving = True
        self._hub.do(self._go_on)

    def stop(self) -> None:
        """Publish a zero Twist at once, whether this desk was driving or not."""
        self._hub.do(self._end)

    def _go_on(self) -> None:
        if not self.driving:
            return
        if time.monotonic() >= self._until_s:
            self._end()
        else:
            self._say(self._forward_m_s, self._turn_rad_s)

    def _end(self) -> None:
        with self._lock:
            self.driving = False
        self._say(0.0, 0.0)

    def _say(self, forward_m_s: float, turn_rad_s: float) -> None:
        twist = self._make()
        twist.linear.x, twist.angular.z = forward_m_s, turn_rad_s
        self._publisher.publish(twist)
