"""How long bytes take on a cable: what was sent in one go arrives in pieces."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

BITS_A_BYTE = 10
"""A start bit, eight bits, a stop bit."""


LATENCY_S = 0.016
"""So long a USB-serial chip gathers bytes; FTDI's application note AN232B-04 tells of 16 ms."""


HELD_S = 0.25
"""So long a packet waits at most for a host that has not read the one before."""

LINE_END = b"\n"
STRIDE = 7
"""The place of a cut goes on by so many bytes, so that lines are cut everywhere in turn."""


@dataclass
class Wire:
    """One direction of a cable. Without a speed, all arrives at once.

    With `packet_s`, what came through arrives only so often, in packets that end within a line. It
    arrives only when the packet before has been read, so that also a host that is late reads
    halves.
    """

    bits_s: float = math.inf
    packet_s: float = 0.0
    _waiting: bytes = field(default=b"", init=False, repr=False)
    _part: float = field(default=0.0, init=False, repr=False)
    """What is already through of the next byte, 0 to 1."""
    _gathered: bytes = field(default=b"", init=False, repr=False)
    _since_packet_s: float = field(default=0.0, init=False, repr=False)
    _packets: int = field(default=0, init=False, repr=False)
    _is_within_a_line: bool = field(default=False, init=False, repr=False)
    """Where the last packet ended: what is gathered begins with the rest of a line."""

    def __call__(self, sent: bytes, dt_s: float, is_read: bool = True) -> bytes:
        """What arrives in this time; the rest waits. Only a wire that is busy makes headway.

        `is_read`: the host has read all that arrived before.
        """
        if not self.packet_s:
            return self._through(sent, dt_s)
        self._gathered += self._through(sent, dt_s)
        self._since_packet_s += dt_s
        if self._since_packet_s < (self.packet_s if is_read else HELD_S):
            return b""
        return self._packet()

    def _packet(self) -> bytes:
        """All that was gathered but for the end of its last line; that comes with the next one."""
        at = self._cut()
        packet, self._gathered = self._gathered[:at], self._gathered[at:]
        if packet:
            self._packets += 1
            self._since_packet_s = 0.0
            self._is_within_a_line = not packet.endswith(LINE_END)
        return packet

    def _cut(self) -> int:
        """A place within the last whole line; behind it all where that one has been cut before."""
        whole = self._gathered.splitlines(keepends=True)[int(self._is_within_a_line) :]
        if not whole or not whole[-1].endswith(LINE_END) or len(whole[-1]) == 1:
            return len(self._gathered)
        inside = 1 + self._packets * STRIDE % (len(whole[-1]) - 1)
        return len(self._gathered) - len(whole[-1]) + inside

    def _through(self, sent: bytes, dt_s: float) -> bytes:
        waiting = self._waiting + sent
        if math.isinf(self.bits_s):
            return waiting
        through = self._part + dt_s * self.bits_s / BITS_A_BYTE
        count = min(len(waiting), int(through))
        self._waiting = waiting[count:]
        self._part = through - count if self._waiting else 0.0
        return waiting[:count]

    def cut(self) -> None:
        """What was under way is lost."""
        self._waiting, self._part, self._gathered = b"", 0.0, b""
        self._is_within_a_line = False
