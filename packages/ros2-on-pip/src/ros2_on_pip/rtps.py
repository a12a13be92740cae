"""The wire protocol of DDS (DDSI-RTPS), as far as it is read here: messages, parts, lists, ports.

What is cut short is passed over: anybody may send anything to a port.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import NamedTuple

PORT_BASE, PORTS_PER_DOMAIN = 7400, 250
"""Domain d has the UDP ports from 7400 + 250 d on (9.6.1.4)."""

HEAD, PART_HEAD = 20, 4
PREFIX = slice(8, 20)
"""Where the sender's name stands in each message (9.4.4)."""

DATA, DATA_FRAGMENT = 0x15, 0x16
LITTLE_ENDIAN = 0x01
SENTINEL = 0x01


class Submessage(NamedTuple):
    """A submessage (9.4.5)."""

    kind: int
    flags: int
    order: str
    """Of its bytes, as `struct` has it."""
    body: bytes


class RtpsParameter(NamedTuple):
    """One of a list (9.4.2.11)."""

    number: int
    value: bytes
    end: int
    """Where it ends in the bytes that were read."""


def ports_of(domain: int) -> range:
    """All UDP ports of a domain."""
    first = PORT_BASE + PORTS_PER_DOMAIN * domain
    return range(first, first + PORTS_PER_DOMAIN)


def parts_in(message: bytes) -> Iterator[Submessage]:
    """The submessages of a message; none where it is no RTPS."""
    place = HEAD
    while message.startswith(b"RTPS") and place + PART_HEAD <= len(message):
        kind, flags = message[place : place + 2]
        order = "<" if flags & LITTLE_ENDIAN else ">"
        (length,) = struct.unpack(f"{order}H", message[place + 2 : place + PART_HEAD])
        end = place + PART_HEAD + length if length else len(message)  # the last may give none
        yield Submessage(kind, flags, order, message[place + PART_HEAD : end])
        place = end


def parameters_in(listed: bytes, order: str, place: int = 0) -> Iterator[RtpsParameter]:
    """The parameters of a list that begins at `place`, and at last the mark of its end."""
    while place + 4 <= len(listed):
        number, length = struct.unpack(f"{order}HH", listed[place : place + 4])
        begin, place = place + 4, place + 4 + (0 if number == SENTINEL else length)
        yield RtpsParameter(number, listed[begin:place], place)
        if number == SENTINEL:
            return
