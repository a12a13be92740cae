"""A subscription of the probe's, whose queue in the middleware is bounded in bytes."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from roslings.probe.budget import MB, ByteBudget
from roslings.probe.events import no_subscription_events
from roslings.probe.wall_clock import to_wall_ns

QUEUE_DEPTH = 5000
"""A raw observer with this depth missed none of 6,000 messages at 1 kHz."""

BLOB_DEPTH = 32
"""Of a type that is made for many bytes, such as a picture: two seconds at 15 Hz."""

MOST_QUEUED = 100_000
LATE_DEPTH = 25
"""Of a topic that comes when the longer queues hold MOST_QUEUED messages. The middleware takes some
500 bytes for each, however small it is. And 180 such queues fill before one is known to."""

OWN_BYTES = MB // 4
QUEUE_BYTES = 32 * MB
QUEUES_BYTES = 64 * MB
"""What a full queue may hold: whatever others hold, at most, and of all large ones of a probe."""

ALL_QUEUES_BYTES = 128 * MB
"""What those of all probes of a grading may hold, which watch side by side."""

WAITED_NS = 10**8
"""A message that waited so long in the queue shows that the queue fills."""

LONGEST_BACKLOG_NS = 60 * 10**9
BLOB = "sequence<uint8>"
Take = Callable[[bytes, Any], None]


class SubscriptionQueues:
    """What the middleware may hold for all subscriptions of a probe."""

    def __init__(self, whole: ByteBudget | None = None) -> None:
        self.bytes = ByteBudget(QUEUES_BYTES, whole)
        self._messages = ByteBudget(MOST_QUEUED)

    def depth(self, wanted: int) -> int:
        """Of one more queue, in messages."""
        return wanted if self._messages.take(wanted) else min(wanted, LATE_DEPTH)

    def close(self) -> None:
        """The middleware holds nothing any more."""
        self.bytes.give_back(QUEUES_BYTES - self.bytes.left)


class RawSubscription:
    """Hears a topic as bytes.

    Middleware bounds a queue in messages, before it knows how large they are. Where large ones
    begin to pile up in it, a shorter queue takes its place, or none: then some are lost.
    """

    def __init__(
        self,
        probe_node: Any,
        kind: type[Any],
        topic: str,
        take: Take,
        profile: Any,
        queues: SubscriptionQueues,
    ) -> None:
        """`profile` is an rclpy QoSProfile; `take` is told the bytes and their MessageInfo."""
        self._node, self._kind, self._topic, self._take = probe_node, kind, topic, take
        self._profile, self._queues = profile, queues.bytes
        longest = BLOB_DEPTH if _holds_blob(kind) else QUEUE_DEPTH
        self._profile.depth = queues.depth(min(profile.depth, longest))
        self._granted = 0
        self._subscription: Any = None
        self.cut_short = False
        """Its queue was made shorter."""
        self._open()

    @property
    def depth(self) -> int:
        """The length of its queue, in messages; 0 where it hears no more."""
        return 0 if self._subscription is None else int(self._profile.depth)

    @property
    def connected(self) -> bool:
        """A publisher and this subscription have found each other: what it sends is heard."""
        return self.depth > 0 and int(self._subscription.get_publisher_count()) > 0

    def _open(self) -> None:
        self._subscription = self._node.create_subscription(
            self._kind,
            self._topic,
            self._hear,
            self._profile,
            raw=True,
            event_callbacks=no_subscription_events(),
        )

    def _hear(self, raw: bytes, info: Any) -> None:
        if not self._fits(self._profile.depth * len(raw)) and waited_ns(info) > WAITED_NS:
            self._shorten(len(raw))
        self._take(raw, info)

    def _fits(self, full_bytes: int) -> bool:
        """A queue full of such messages is granted."""
        more = full_bytes - self._granted
        if more > 0 and full_bytes <= QUEUE_BYTES and self._queues.take(more):
            self._granted = full_bytes
        return full_bytes <= max(self._granted, OWN_BYTES)

    def _shorten(self, size: int) -> None:
        """As long as there is room for; deaf where there is none."""
        from rclpy.qos import DurabilityPolicy

        if self._subscription is None:
            return
        self.cut_short = True
        self._node.destroy_subscription(self._subscription)
        self._subscription = None
        self._queues.give_back(self._granted)
        self._granted = 0
        depth = max(OWN_BYTES, min(QUEUE_BYTES, self._queues.left)) // size
        if depth and self._fits(depth * size):
            self._profile.depth = depth
            self._profile.durability = DurabilityPolicy.VOLATILE  # or it would hear all again
            self._open()


def _holds_blob(kind: type[Any]) -> bool:
    return BLOB in kind.get_fields_and_field_types().values()


def arrival_ns(info: Any) -> int:
    """When the middleware received a message, by the monotonic clock.

    The middleware stamps by the wall clock, which may have been set meanwhile: then it is now.
    """
    arrived_ns, now_ns = int(info["received_timestamp"]) - to_wall_ns(), time.monotonic_ns()
    return arrived_ns if 0 <= now_ns - arrived_ns < LONGEST_BACKLOG_NS else now_ns


def waited_ns(info: Any) -> int:
    """How long a message waited here, since the middleware received it."""
    return time.monotonic_ns() - arrival_ns(info)
