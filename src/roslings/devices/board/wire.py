"""How long bytes take on a cable: what was sent in one go arrives in pieces."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

BITS_A_BYTE = 10
"""A start bit, eight bits, a stop bit."""


LATENCY_S = 0.016
"""So long a USB-serial chip gathers bytes; FTDI's application note AN232B-04 tells of 16 ms."""


@dataclass
class Wire:
    """One direction of a cable. Without a speed, all arrives at once.

    With `packet_s`, what came through arrives only so often, cut wherever it was then.
    """

    bits_s: float = math.inf
    packet_s: float = 0.0
    _waiting: bytes = field(default=b"", init=False, repr=False)
    _part: float = field(default=0.0, init=False, repr=False)
    """What is already through of the next byte, 0 to 1."""
    _gathered: bytes = field(default=b"", init=False, repr=False)
    _since_packet_s: float = field(default=0.0, init=False, repr=False)

    def __call__(self, sent: bytes, dt_s: float) -> bytes:
        """What arrives in this time; the rest waits. Only a wire that is busy makes headway."""
        if not self.packet_s:
            return self._through(sent, dt_s)
        since_s = self._since_packet_s + dt_s
        late_s = since_s % self.packet_s if since_s >= self.packet_s else dt_s
        arrived = self._gathered + self._through(sent, dt_s - late_s)
        after = self._through(b"", late_s)
        if since_s < self.packet_s:
            self._gathered, self._since_packet_s = arrived + after, since_s
            return b""
        self._gathered, self._since_packet_s = after, late_s
        return arrived

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
