"""What the student's nodes say to each other, read from the packets on this computer's loopback.

Nothing of ours is in their domain, so a node cannot know that somebody reads along. A node that
writes what it never heard is found out. The kernel hands over a copy of each packet (packet(7)).
Writers make their topics known in announcements, and samples name their writer (DDSI-RTPS 9.4.5,
9.6.3).
"""

from __future__ import annotations

import socket
import struct
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from ros2_on_pip.rtps import (
    DATA,
    DATA_FRAGMENT,
    PREFIX,
    Submessage,
    parameters_in,
    parts_in,
    ports_of,
)

LOOPBACK = "lo"
EVERY_PROTOCOL = 0x0003
TO_US = 0
"""On the loopback each packet leaves and arrives: the arriving copy counts (packet(7))."""

TIMESTAMP_NS = 35
"""SO_TIMESTAMPNS: the kernel says when a packet came, however late it is read (socket(7))."""

PACKET_OPTIONS, STATISTICS = 263, 6
"""SOL_PACKET and PACKET_STATISTICS: how many came, and how many found no room (packet(7))."""

ROOM_BYTES = 4 * 1024 * 1024
LONGEST = 65536
TURN_S = 0.1
IP_UDP = 17
UDP_HEAD, SAMPLE_HEAD, ENCODING = 8, 20, 4
INLINE_QOS = 0x02
ANNOUNCES_WRITERS = b"\0\0\3\xc2"
USERS_WRITERS = (0x02, 0x03)
"""The last byte of the name of a writer that a program made: with a key, and without."""

TOPIC_NAME, ENDPOINT_GUID = 0x05, 0x5A
ROS_TOPIC = "rt"
MOST_SAMPLES, MOST_TOPICS = 20_000, 2_000
"""No flood fills our memory: what comes later is not kept, and the pace is known by then."""


@dataclass(frozen=True)
class Sample:
    """One submessage that carries data, or a part of it."""

    writer: bytes
    """Participant's and writer's name: 16 bytes."""
    number: int
    content: bytes
    """What follows the inline QoS, with its four bytes of encoding."""
    order: str


@dataclass
class SentSamples:
    """What was sent by the programs' own writers."""

    topics: dict[bytes, str] = field(default_factory=dict)
    samples: dict[tuple[bytes, int], int] = field(default_factory=dict)
    """Writer and number of each sample, to the nanosecond at which it was sent first."""

    def add(self, packet: bytes, domain: int, at_ns: int) -> None:
        """One packet as the kernel gives it, from its IP header on."""
        for sample in samples_in(rtps_of(packet, domain)):
            if sample.writer[12:] == ANNOUNCES_WRITERS:
                if len(self.topics) < MOST_TOPICS:
                    self.topics.update(announced(sample))
            elif sample.writer[-1] in USERS_WRITERS and len(self.samples) < MOST_SAMPLES:
                self.samples.setdefault((sample.writer, sample.number), at_ns)

    def sent_ns(self, topic: str) -> list[int]:
        """When something was sent on a ROS topic, in order."""
        writers = {writer for writer, name in self.topics.items() if name == ROS_TOPIC + topic}
        return sorted(at for (writer, _), at in self.samples.items() if writer in writers)


class Tap:
    """Reads in a thread of its own until it is closed."""

    def __init__(self, source: socket.socket, domain: int) -> None:
        self._source, self._domain = source, domain
        self._heard, self._lock, self._over = SentSamples(), threading.Lock(), threading.Event()
        self._thread = threading.Thread(target=self._read, daemon=True, name="packets")
        self._thread.start()

    def sent_ns(self, topic: str) -> list[int]:
        """When something was sent on a ROS topic so far, in order."""
        with self._lock:
            return self._heard.sent_ns(topic)

    def lost(self) -> int:
        """How many packets found no room since this was asked last."""
        _, dropped = struct.unpack("II", self._source.getsockopt(PACKET_OPTIONS, STATISTICS, 8))
        return int(dropped)

    def close(self) -> None:
        """Read no more."""
        self._over.set()
        self._thread.join()
        self._source.close()

    def _read(self) -> None:
        while not self._over.is_set():
            try:
                packet, more, _, sender = self._source.recvmsg(LONGEST, 128)
            except TimeoutError:
                continue
            if sender[2] == TO_US:
                with self._lock:
                    self._heard.add(packet, self._domain, _time_in(more))


@contextmanager
def tapped(domain: int) -> Iterator[Tap | None]:
    """Read along with the nodes of `domain`; None where the kernel lets nobody do that here."""
    try:
        source = _listening()
    except (OSError, AttributeError):  # no right to it, no such network, or no Linux
        yield None
        return
    tap = Tap(source, domain)
    try:
        yield tap
    finally:
        tap.close()


def _listening() -> socket.socket:
    source = socket.socket(socket.AF_PACKET, socket.SOCK_DGRAM, socket.htons(EVERY_PROTOCOL))
    try:
        source.bind((LOOPBACK, EVERY_PROTOCOL))
        source.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, ROOM_BYTES)
        source.setsockopt(socket.SOL_SOCKET, TIMESTAMP_NS, 1)
        source.settimeout(TURN_S)
    except OSError:
        source.close()
        raise
    return source


def _time_in(more: list[tuple[int, int, bytes]]) -> int:
    """The kernel's time of a packet, in nanoseconds."""
    for level, kind, value in more:
        if (level, kind) == (socket.SOL_SOCKET, TIMESTAMP_NS):
            seconds, nanoseconds = struct.unpack("qq", value[:16])
            return int(seconds * 10**9 + nanoseconds)
    return 0


# --- what is in a packet -----------------------------------------------------------------------


def rtps_of(packet: bytes, domain: int) -> bytes:
    """The RTPS message in an IPv4 packet to a port of `domain`; empty where there is none."""
    head = (packet[0] & 0x0F) * 4 if packet else 0
    if len(packet) < head + UDP_HEAD or packet[0] >> 4 != 4 or packet[9] != IP_UDP:
        return b""
    (port,) = struct.unpack("!H", packet[head + 2 : head + 4])
    message = packet[head + UDP_HEAD :]
    return message if port in ports_of(domain) and message.startswith(b"RTPS") else b""


def samples_in(message: bytes) -> Iterator[Sample]:
    """Every sample of an RTPS message; what is cut short, or no sample, is passed over."""
    for part in parts_in(message):
        if part.kind in (DATA, DATA_FRAGMENT) and len(part.body) >= SAMPLE_HEAD:
            yield _sample(message[PREFIX], part)


def _sample(participant: bytes, part: Submessage) -> Sample:
    body, order = part.body, part.order
    high, low = struct.unpack(f"{order}iI", body[12:20])
    (skipped,) = struct.unpack(f"{order}H", body[2:4])
    begin = 4 + skipped
    if part.flags & INLINE_QOS:
        ends = [each.end for each in parameters_in(body, order, begin)]
        begin = ends[-1] if ends else begin
    return Sample(participant + body[8:12], (high << 32) + low, body[begin:], order)


def announced(sample: Sample) -> dict[bytes, str]:
    """The writer that a sample of its participant makes known, and its topic."""
    listed = parameters_in(sample.content, sample.order, ENCODING)
    facts = {each.number: each.value for each in listed}
    name, writer = facts.get(TOPIC_NAME, b""), facts.get(ENDPOINT_GUID, b"")
    return {writer: name[4:].partition(b"\0")[0].decode("utf-8", "replace")} if writer else {}
