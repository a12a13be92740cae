"""Who takes part in a ROS domain on this computer: asked by name, and answered at once.

A DDS participant introduces itself to each newcomer (DDSI-RTPS 8.5.3.2). But Fast DDS makes itself
known before it listens: what quick neighbours answer in that moment is lost, and they speak again
only with their next announcement, up to 3 s later. So, once our participant listens, a second
newcomer asks from a plain socket, and hands on to our participant what comes back. The newcomer
has no endpoints and no ROS node, and is forgotten after a second.

The answers also tell which participant holds which port: who holds none any more has ended,
whatever was heard of it.
"""

from __future__ import annotations

import os
import socket
import struct
import threading
from collections.abc import Iterable, Iterator
from contextlib import suppress
from types import TracebackType

from ros2_on_pip.participants import HERE, own_participants, participants_here
from ros2_on_pip.rtps import (
    DATA,
    LITTLE_ENDIAN,
    PREFIX,
    SENTINEL,
    Parameter,
    parameters_in,
    parts_in,
)

VENDOR = b"\x01\x0f"
"""Fast DDS's: a participant of an unknown vendor may be passed over."""

PROTOCOL = b"\x02\x03"
LEASE_S = 1
TURN_S = 0.01
TURNS_TO_ANSWER = 10
"""Who has not answered then is asked again: a datagram may be lost."""

MOST_TURNS = 1000
"""Who is silent for so long will not answer."""

UNKNOWN_READER, ANNOUNCER = b"\0\0\0\0", b"\0\1\0\xc2"
PARTICIPANT = b"\0\0\1\xc1"
ANNOUNCES_AND_DETECTS = 3
WITH_DATA = 0x04
LEASE, VERSION, VENDOR_ID, GUID, BUILT_IN = 0x02, 0x15, 0x16, 0x50, 0x58
DEFAULT_LOCATOR, METATRAFFIC_LOCATOR = 0x31, 0x32
UDP_V4 = 1
LISTED = 24
"""Where the list begins in the body of an announcement."""

LONGEST = 65536


class RollCall:
    """Asks each participant of a domain who it is. A context manager: it holds a socket.

    It asks and hears in a thread of its own, so that the answers are there as soon as our own
    participant is, while Python is still busy with the rest of rclpy.
    """

    def __init__(self, domain: int) -> None:
        self._domain = domain
        self._answered: dict[int, bytes] = {}
        self._heard: dict[bytes, bytes] = {}
        self._known: frozenset[bytes] = frozenset()
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self) -> RollCall:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind((HERE, 0))
        self._socket.setblocking(False)
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._over.set()
        self._thread.join()
        self._socket.close()

    def _run(self) -> None:
        for turn in range(MOST_TURNS):
            if turn % TURNS_TO_ANSWER == 0:
                self._ask()
            self._hear()
            if self._over.wait(TURN_S):
                return

    def _ask(self) -> None:
        """Ask those who have not answered yet; each time as another newcomer."""
        message = announcement(os.urandom(12), self._socket.getsockname()[1])
        for port in participants_here(self._domain) - self._answered.keys():
            self._send(message, port)

    def _hear(self) -> None:
        """Take the answers, and hand them on until our own participant knows who sent them."""
        for message in self._waiting():
            ports = ports_in(message)
            self._answered.update(dict.fromkeys(ports, message[PREFIX]))
            if ports:
                self._heard[message[PREFIX]] = message
        unknown = [text for name, text in self._heard.items() if name not in self._known]
        for port in own_participants(self._domain) if unknown else ():
            for text in unknown:
                self._send(text, port)

    def knows(self, participants: frozenset[bytes]) -> None:
        """Our own participant knows these: what they said need not be handed on any more."""
        self._known = participants

    def named(self, ports: Iterable[int]) -> frozenset[bytes] | None:
        """The participants that hold `ports`; None where one of them did not answer."""
        names = [self._answered.get(port) for port in ports]
        return None if None in names else frozenset(name for name in names if name)

    def _waiting(self) -> Iterator[bytes]:
        with suppress(BlockingIOError):
            while True:
                yield self._socket.recv(LONGEST)

    def _send(self, message: bytes, port: int) -> None:
        with suppress(OSError):  # who has just closed its port needs no question
            self._socket.sendto(message, (HERE, port))


def announcement(prefix: bytes, port: int) -> bytes:
    """A participant's first word: it is new, and hears at `port` of this computer (8.5.3.2)."""
    place = struct.pack("<iI", UDP_V4, port) + bytes(12) + socket.inet_aton(HERE)
    facts = (
        (VERSION, PROTOCOL + b"\0\0"),
        (VENDOR_ID, VENDOR + b"\0\0"),
        (GUID, prefix + PARTICIPANT),
        (METATRAFFIC_LOCATOR, place),
        (DEFAULT_LOCATOR, place),
        (LEASE, struct.pack("<iI", LEASE_S, 0)),
        (BUILT_IN, struct.pack("<I", ANNOUNCES_AND_DETECTS)),
        (SENTINEL, b""),
    )
    listed = b"".join(struct.pack("<HH", fact, len(value)) + value for fact, value in facts)
    flags_and_offset = struct.pack("<HH", 0, 16)
    body = flags_and_offset + UNKNOWN_READER + ANNOUNCER + struct.pack("<iI", 0, 1)
    body += b"\x00\x03\x00\x00" + listed  # a list of parameters, little-endian (9.4.2.11)
    head = struct.pack("<BBH", DATA, LITTLE_ENDIAN | WITH_DATA, len(body))
    return b"RTPS" + PROTOCOL + VENDOR + prefix + head + body


def ports_in(message: bytes) -> list[int]:
    """The ports at which the sender of an announcement hears announcements of others."""
    try:
        return [
            struct.unpack(f"{order}I", fact.value[4:8])[0]
            for order, fact in _facts(message)
            if fact.number == METATRAFFIC_LOCATOR
        ]
    except struct.error:  # cut short, or another's words
        return []


def _facts(message: bytes) -> Iterator[tuple[str, Parameter]]:
    """Byte order and parameter, for each parameter of an announcement."""
    for part in parts_in(message):
        if part.kind == DATA and part.body[8:12] == ANNOUNCER:
            for fact in parameters_in(part.body, part.order, LISTED):
                yield part.order, fact
