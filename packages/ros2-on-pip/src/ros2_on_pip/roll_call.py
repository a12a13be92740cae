"""Who takes part in a ROS domain on this computer: asked by name, and answered at once.

A DDS participant introduces itself to each newcomer (DDSI-RTPS 8.5.3.2). But Fast DDS makes itself
known before it listens, and what quick neighbours answer in that moment is lost. They speak again
only with their next announcement, up to 3 s later. So, once our participant listens, a second
newcomer asks from a plain socket, and hands on to our participant what comes back. The newcomer has
no endpoints and no ROS node, and is forgotten after a second.

Who has been introduced is asked for its endpoints. Fast DDS does that after 70 ms, and if it was
too early, again after 140 ms, 280 ms and so on. So for who only looks we ask in its place, with a
question that counts less than each of its own. Whoever has heard one of those passes ours over.

The answers also tell which participant holds which port: who holds none any more has ended,
whatever was heard of it.
"""

from __future__ import annotations

import os
import socket
import struct
import threading
from collections import deque
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from types import TracebackType

from ros2_on_pip.participants import (
    BELIEVED_READINGS,
    HERE,
    give_room,
    own_participants,
    participants_here,
)
from ros2_on_pip.rtps import (
    DATA,
    HEAD,
    LITTLE_ENDIAN,
    PREFIX,
    SENTINEL,
    RtpsParameter,
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

MOST_TURNS_BETWEEN = 16
"""What is handed on again had come too early, or was lost. The pause doubles each time, up to this:
what came more often would leave no room for what others say."""

MOST_TURNS = 1000
"""Who is silent for so long will not answer."""

UNKNOWN_READER, ANNOUNCER = b"\0\0\0\0", b"\0\1\0\xc2"
TELL_OF_ENDPOINTS = (b"\0\0\3", b"\0\0\4")
"""Who tells of publishers, and who of subscriptions (9.3.1.3), to a reader of the same number."""

BUILT_IN_WRITER, BUILT_IN_READER = b"\xc2", b"\xc7"
ACKNOWLEDGED, MEANT_FOR = 0x06, 0x0E
MADE_BY = slice(6, 8)
"""Where each message has its vendor (9.4.4)."""

PARTICIPANT = b"\0\0\1\xc1"
ANNOUNCES_AND_DETECTS = 3
WITH_DATA = 0x04
LEASE, VERSION, VENDOR_ID, GUID, BUILT_IN = 0x02, 0x15, 0x16, 0x50, 0x58
DEFAULT_LOCATOR, METATRAFFIC_LOCATOR = 0x31, 0x32
UDP_V4 = 1
LISTED = 24
"""Where the list begins in the body of an announcement."""

LONGEST = 65536


@dataclass
class HeardAnswer:
    """What a participant said of itself, and when it is handed on again."""

    message: bytes
    due_turn: int = 0
    pause_turns: int = 1

    @property
    def handed_on_before(self) -> bool:
        """Our own participant may know it by now."""
        return self.pause_turns > 1

    def handed_on(self, turn: int) -> None:
        """Each time, the next one is twice as far away."""
        self.due_turn = turn + self.pause_turns
        self.pause_turns = min(2 * self.pause_turns, MOST_TURNS_BETWEEN)


def not_yet_asked(
    here: frozenset[int], asked: Iterable[int], answered: Iterable[int], again: bool
) -> frozenset[int]:
    """Those of the ports `here` whose participant is to be asked now.

    Who is new, at once; with `again`, everybody who has not answered.
    """
    return here.difference(answered, () if again else asked)


class RollCall:
    """Asks each participant of a domain who it is. A context manager: it holds a socket.

    It asks and hears in a thread of its own. So the answers are there as soon as our own
    participant is, while Python is still busy with the rest of rclpy.
    """

    def __init__(self, domain: int, hurries: bool = True) -> None:
        """Who `hurries` knows the others' endpoints sooner than they know its own."""
        self._domain, self._hurries = domain, hurries
        self._answered: dict[int, bytes] = {}
        self._asked: set[int] = set()
        self._heard: dict[bytes, HeardAnswer] = {}
        self._known: frozenset[bytes] = frozenset()
        self._roomy: frozenset[int] = frozenset()
        self.readings: deque[frozenset[int]] = deque(maxlen=BELIEVED_READINGS)
        """Which ports the kernel showed in the last turns, the newest last."""

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
            self._ask(again=turn % TURNS_TO_ANSWER == 0)
            self._hear()
            self._hand_on(turn)
            if self._over.wait(TURN_S):
                return

    def _ask(self, again: bool) -> None:
        """Ask who is new, or has not answered yet; each time as another newcomer."""
        here = participants_here(self._domain)
        self.readings.append(here)
        silent = not_yet_asked(here, self._asked, self._answered, again)
        message = announcement(os.urandom(12), self._socket.getsockname()[1]) if silent else b""
        for port in silent:
            self._send(message, port)
        self._asked |= silent

    def _hear(self) -> None:
        for message in self._waiting():
            if ports := ports_in(message):
                self._answered.update(dict.fromkeys(ports, message[PREFIX]))
                self._heard.setdefault(message[PREFIX], HeardAnswer(message)).message = message

    def _hand_on(self, turn: int) -> None:
        """Tell our own participant what it does not know yet; whom it was told of, it asks."""
        unknown = [one for name, one in self._heard.items() if name not in self._known]
        due = [one for one in unknown if one.due_turn <= turn]
        own = self._own_with_room() if due else frozenset()
        for one in due if own else ():
            if one.handed_on_before and self._hurries:
                self._ask_for_endpoints(one.message, own)
            for port in own:
                self._send(one.message, port)
            one.handed_on(turn)

    def _ask_for_endpoints(self, answer: bytes, own: frozenset[int]) -> None:
        askers = {self._answered[port] for port in own & self._answered.keys()}
        for asker in askers - {answer[PREFIX]}:
            question = first_question(self._heard[asker].message, answer[PREFIX])
            for port in ports_in(answer) if question else ():
                self._send(question, port)

    def _own_with_room(self) -> frozenset[int]:
        """The ports of our own participants, each with room for all that the others answer."""
        own = own_participants(self._domain)
        if own - self._roomy:
            give_room(self._domain)
            self._roomy |= own
        return own

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


def first_question(said_by_asker: bytes, asked: bytes) -> bytes:
    """Who has nothing yet of the endpoints of `asked` wants to know how many there are.

    It acknowledges none (8.3.7.1), with the count 0: below each that the asker itself gives. Empty
    where the asker, of whom `said_by_asker` is a message, is not of Fast DDS: only that asks so.
    """
    if said_by_asker[MADE_BY] != VENDOR:
        return b""
    meant_for = struct.pack("<BBH", MEANT_FOR, LITTLE_ENDIAN, len(asked)) + asked
    none_with_count = struct.pack("<iIIi", 0, 0, 0, 0)
    questions = (
        struct.pack("<BBH", ACKNOWLEDGED, LITTLE_ENDIAN, 2 * 4 + len(none_with_count))
        + number
        + BUILT_IN_READER
        + number
        + BUILT_IN_WRITER
        + none_with_count
        for number in TELL_OF_ENDPOINTS
    )
    return said_by_asker[:HEAD] + meant_for + b"".join(questions)


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


def _facts(message: bytes) -> Iterator[tuple[str, RtpsParameter]]:
    """Byte order and parameter, for each parameter of an announcement."""
    for part in parts_in(message):
        if part.kind == DATA and part.body[8:12] == ANNOUNCER:
            for fact in parameters_in(part.body, part.order, LISTED):
                yield part.order, fact
