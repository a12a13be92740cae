"""Hear every message on a topic, with stamp, sequence number and arrival."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from roslings.evidence import Endpoint, MessageSeen, TopicSeen
from roslings.probe.budget import Store, size_of
from roslings.probe.content import UnknownType, message_class, to_plain
from roslings.probe.raw_subscription import (
    QUEUE_DEPTH,
    RawSubscription,
    SubscriptionQueues,
    arrival_ns,
)

MOST_MESSAGES = 20_000
LARGEST_CONTENT = 64 * 1024
OWN_BYTES = 32 * 1024
"""Of each topic: 40 short texts are kept, whatever goes on beside it."""

MESSAGE_BYTES = 400
"""Of one message without its content, with what JSON writes of it."""

TEXT_BYTES = 320
"""Of a content with one field, beside its text: as bytes, as a value, and as JSON."""

Read = Callable[[Any], Any]
"""Makes the plain values of a message that are to be kept."""


class TopicRecorder:
    """One subscription of the probe's; it takes bytes, and reads them when there is time."""

    def __init__(
        self,
        probe_node: Any,
        endpoint: Endpoint,
        heard: Callable[[], None],
        store: Store | None = None,
        readers: Mapping[str, Read] | None = None,
        queues: SubscriptionQueues | None = None,
    ) -> None:
        """Keeps what `store` has room for; `queues` is what the middleware may hold for us.

        A type in `readers`, which may change, is read when a message comes, whatever its size.

        Raises UnknownType where the message type is not installed.
        """
        self.seen = TopicSeen(name=endpoint.topic, type=endpoint.type)
        self.reliability = endpoint.qos.reliability
        self._class = message_class(endpoint.type)
        self._heard = heard
        self._store = store or Store()
        self._share = self._store.share(OWN_BYTES)
        self._readers = {} if readers is None else readers
        self._raw: list[bytes] = []
        self._subscription = RawSubscription(
            probe_node,
            self._class,
            endpoint.topic,
            self._take,
            _matching_qos(endpoint),
            queues or SubscriptionQueues(),
        )

    @property
    def count(self) -> int:
        """How many messages came, those that are not kept too."""
        return len(self.seen.messages) + self.seen.not_kept

    def _take(self, raw: bytes, info: Any) -> None:
        arrived_ns = arrival_ns(info)
        content = self._read_now(raw)
        taken = self._taken_for(raw, content)
        if len(self.seen.messages) < MOST_MESSAGES and self._share.take(taken):
            self._keep(raw, info, arrived_ns, content)
        else:
            self._share.full = True
            self.seen.not_kept += 1
            self._store.drop("messages", 1, len(raw))
        self._heard()

    def _taken_for(self, raw: bytes, content: Any) -> int:
        """What a message will take of the store, as far as that is known before it is read."""
        later = _guess(raw) if len(raw) <= LARGEST_CONTENT else 0
        return MESSAGE_BYTES + later + (0 if content is None else size_of(content))

    def _keep(self, raw: bytes, info: Any, arrived_ns: int, content: Any) -> None:
        fits = len(raw) <= LARGEST_CONTENT or self._store.large.take(len(raw))
        self._raw.append(raw if fits else b"")
        self.seen.messages.append(
            MessageSeen(
                source_ns=info["source_timestamp"] or None,
                sequence=info["publication_sequence_number"],
                arrival_ns=arrived_ns,
                size=len(raw),
                content=content,
            )
        )

    def _read_now(self, raw: bytes) -> Any:
        read = self._readers.get(self.seen.type)
        return read(self._message(raw)) if read and not self._share.full else None

    @property
    def connected(self) -> bool:
        """A publisher and this subscription have found each other: what it sends is heard."""
        return self._subscription.connected

    def raw_messages(self) -> Iterator[tuple[MessageSeen, bytes]]:
        """Each message whose bytes were kept, and these, as they came."""
        return ((m, raw) for m, raw in zip(self.seen.messages, self._raw, strict=True) if raw)

    def read_contents(self) -> None:
        """Turn the bytes into values, after the watch, so that reading delays no message."""
        self.seen.cut_short = self._subscription.cut_short
        for message, raw in zip(self.seen.messages, self._raw, strict=True):
            if message.content is None:
                message.content = self._content(raw) if 0 < len(raw) <= LARGEST_CONTENT else None
                self.seen.not_read += message.content is None

    def _content(self, raw: bytes) -> Any:
        """The values; None where there is no room for them."""
        content = to_plain(self._message(raw))
        more = size_of(content) - _guess(raw)
        if more > 0:
            return content if self._share.take(more) else None
        self._share.give_back(-more)
        return content

    def _message(self, raw: bytes) -> Any:
        from rclpy.serialization import deserialize_message

        return deserialize_message(raw, self._class)


def _guess(raw: bytes) -> int:
    """What the bytes of a message take with the values in them, where these are mostly a text."""
    return TEXT_BYTES + 3 * len(raw)


def can_record(endpoint: Endpoint) -> bool:
    """The type of its messages is installed here."""
    try:
        message_class(endpoint.type)
    except UnknownType:
        return False
    return True


def _matching_qos(endpoint: Endpoint) -> Any:
    """Ask for no more than the publisher offers, so that every publisher is heard."""
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    best_effort = endpoint.qos.reliability == "best_effort"
    return QoSProfile(
        depth=QUEUE_DEPTH,
        reliability=ReliabilityPolicy.BEST_EFFORT if best_effort else ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.VOLATILE,
    )
