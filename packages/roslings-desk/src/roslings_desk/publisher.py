"""A publisher of a page: one message, or one again and again by a timer of the node."""

from __future__ import annotations

import math
from types import TracebackType
from typing import Any

from ros2_on_pip.interfaces import class_of
from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.yaml_in import Stamp
from roslings_desk.hub import Hub

FASTEST_HZ = 1_000.0


class BadRate(CommandProblem):
    """What was typed is no rate."""

    def __init__(self, typed: str) -> None:
        super().__init__(
            f"'{typed}' is no rate. Type a number of messages a second, for example 2 or 0.5;"
            f" {FASTEST_HZ:g} at most."
        )


class Publisher:
    """A context manager: leaving the block ends it."""

    def __init__(self, hub: Hub, topic: str, type_name: str) -> None:
        self._hub, self._topic = hub, topic
        self._cls = class_of(type_name, "msg")
        self._publisher: Any = None
        self._timer: Any = None
        self.count = 0
        """Messages that were sent by `publish`."""

    def __enter__(self) -> Publisher:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._hub.do(self._close)

    @property
    def listeners(self) -> int:
        """How many subscriptions hear what is published now."""
        return int(self._publisher.get_subscription_count()) if self._publisher else 0

    def announce(self) -> None:
        """Be there before the first message, so that nobody who listens misses it."""
        self._hub.do(self._open)

    def publish(self, message: Any, stamps: list[Stamp]) -> None:
        """Send it once."""
        self.count += 1
        self._hub.do(lambda: self._send(message, stamps))

    def repeat(self, message: Any, stamps: list[Stamp], typed_hz: str) -> None:
        """Send it at a rate until `end`; in place of what was sent before. Raises BadRate."""
        period_s = 1 / _rate_hz(typed_hz)
        self._hub.do(lambda: self._begin(message, stamps, period_s))

    def end(self) -> None:
        """Send nothing any more."""
        self._hub.do(self._end)

    # --- in the thread that spins ----------------------------------------------------------

    def _open(self) -> None:
        if self._publisher is None:
            node = self._hub.desk_node.node
            self._publisher = node.create_publisher(self._cls, self._topic, 10)

    def _send(self, message: Any, stamps: list[Stamp]) -> None:
        self._open()
        node = self._hub.desk_node.node
        now = node.get_clock().now().to_msg() if stamps else None
        for stamp in stamps:
            stamp(now)
        self._publisher.publish(message)

    def _begin(self, message: Any, stamps: list[Stamp], period_s: float) -> None:
        self._end()
        send = lambda: self._send(message, stamps)  # noqa: E731
        self._timer = self._hub.desk_node.node.create_timer(period_s, send)

    def _end(self) -> None:
        if self._timer is not None:
            self._hub.desk_node.node.destroy_timer(self._timer)
            self._timer = None

    def _close(self) -> None:
        self._end()
        if self._publisher is not None:
            self._hub.desk_node.node.destroy_publisher(self._publisher)


def _rate_hz(typed: str) -> float:
    try:
        rate_hz = float(typed)
    except ValueError:
        raise BadRate(typed) from None
    if not (math.isfinite(rate_hz) and 0 < rate_hz <= FASTEST_HZ):
        raise BadRate(typed)
    return rate_hz
