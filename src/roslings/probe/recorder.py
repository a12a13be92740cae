"""Hear every message on a topic, with stamp, sequence number and arrival."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from roslings.evidence import Endpoint, MessageSeen, TopicSeen
from roslings.probe.content import UnknownType, message_class, to_plain
from roslings.probe.events import no_ear_events

QUEUE_DEPTH = 5000
"""A raw observer with this depth missed none of 6,000 messages at 1 kHz."""

LONGEST_BACKLOG_NS = 60 * 10**9
MOST_MESSAGES = 20_000
MOST_MESSAGES_IN_ALL = 100_000
LARGEST_CONTENT = 64 * 1024
MOST_RAW_BYTES = 64 * 1024 * 1024
MOST_CONTENT_CHARACTERS = 16 * 1024 * 1024
Read = Callable[[Any], Any]
"""Makes the plain values of a message that are to be kept."""


class Allowance:
    """How much of something may be kept: one for all topics of an experiment."""

    def __init__(self, left: int = 0) -> None:
        self._left = left

    def take(self, size: int) -> bool:
        """Take `size` of it, where as much is left."""
        fits = size <= self._left
        self._left -= size if fits else 0
        return fits


class Store:
    """What all topics of an experiment may keep together, so that no node fills our memory.

    `large_bytes` are for messages above LARGEST_CONTENT, whose contents are never read.
    """

    def __init__(self, large_bytes: int = 0) -> None:
        self.messages = Allowance(MOST_MESSAGES_IN_ALL)
        self.contents = Allowance(MOST_CONTENT_CHARACTERS)
        self._raw = Allowance(MOST_RAW_BYTES)
        self._large = Allowance(large_bytes)

    def keeps(self, raw: bytes) -> bool:
        """Whether there is room for the bytes of a message."""
        return (self._raw if len(raw) <= LARGEST_CONTENT else self._large).take(len(raw))


class Recorder:
    """One subscription of the probe's; it takes bytes, and reads them when there is time."""

    def __init__(
        self,
        eye: Any,
        endpoint: Endpoint,
        heard: Callable[[], None],
        store: Store | None = None,
        readers: Mapping[str, Read] | None = None,
    ) -> None:
        """Keeps what `store` has room for.

        A type in `readers`, which may change, is read when a message comes, whatever its size.

        Raises UnknownType where the message type is not installed.
        """
        self.seen = TopicSeen(name=endpoint.topic, type=endpoint.type)
        self.reliability = endpoint.qos.reliability
        self._class = message_class(endpoint.type)
        self._heard = heard
        self._store = store or Store()
        self._readers = {} if readers is None else readers
        self._raw: list[bytes] = []
        self._subscription = eye.create_subscription(
            self._class, endpoint.topic, self._take, _matching_qos(endpoint), raw=True,
            event_callbacks=no_ear_events(),
        )  # fmt: skip

    def _take(self, raw: bytes, info: Any) -> None:
        arrival_ns = _arrival_ns(info)
        if len(self.seen.messages) < MOST_MESSAGES and self._store.messages.take(1):
            self._keep(raw, info, arrival_ns)
        else:
            self.seen.not_kept += 1
        self._heard()

    def _keep(self, raw: bytes, info: Any, arrival_ns: int) -> None:
        self._raw.append(raw if self._store.keeps(raw) else b"")
        self.seen.messages.append(
            MessageSeen(
                source_ns=info["source_timestamp"] or None,
                sequence=info["publication_sequence_number"],
                arrival_ns=arrival_ns,
                size=len(raw),
                content=self._read_now(raw),
            )
        )

    def _read_now(self, raw: bytes) -> Any:
        read = self._readers.get(self.seen.type)
        return read(self._message(raw)) if read else None

    @property
    def connected(self) -> bool:
        """A publisher and this subscription have found each other: what it sends is heard."""
        return int(self._subscription.get_publisher_count()) > 0

    def raw_messages(self) -> Iterator[tuple[MessageSeen, bytes]]:
        """Each message whose bytes were kept, and these, as they came."""
        return ((m, raw) for m, raw in zip(self.seen.messages, self._raw, strict=True) if raw)

    def read_contents(self) -> None:
        """Turn the bytes into values, after the watch, so that reading delays no message."""
        for message, raw in zip(self.seen.messages, self._raw, strict=True):
            if message.content is None and 0 < len(raw) <= LARGEST_CONTENT:
                content = to_plain(self._message(raw))
                if self._store.contents.take(len(str(content))):
                    message.content = content

    def _message(self, raw: bytes) -> Any:
        from rclpy.serialization import deserialize_message

        return deserialize_message(raw, self._class)


def _arrival_ns(info: Any) -> int:
    """When the middleware received a message, on the monotonic clock.

    Its own thread receives; this thread may be busy with the messages before, so the time of
    taking would be late. The middleware stamps by the wall clock, a moment ago: how long ago is
    the same on both clocks.
    """
    now_ns, ago_ns = time.monotonic_ns(), time.time_ns() - info["received_timestamp"]
    return now_ns - ago_ns if 0 <= ago_ns < LONGEST_BACKLOG_NS else now_ns


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
