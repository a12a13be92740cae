"""When a public key of apt's ends, read from the key file itself (OpenPGP, RFC 9580).

Only what is needed is read. Public-key packets (tag 6) carry the day of making. Their signatures
(tag 2) carry the life time in seconds in subpacket 9.
"""

from __future__ import annotations

import base64
import binascii
import re
from collections.abc import Iterator
from dataclasses import dataclass

PUBLIC_KEY = 6
SIGNATURE = 2
CREATED = 2
KEY_LIFE = 9


class NotAKey(Exception):
    """The file is not an OpenPGP public key."""


@dataclass(frozen=True)
class Packet:
    """One packet of an OpenPGP file."""

    tag: int
    body: bytes


def key_ends(content: bytes) -> float | None:
    """Return when the first key of a key file ends, in seconds since 1970; None means never.

    Raises:
        NotAKey: the file holds no key that can be read.
    """
    try:
        return _ends(list(_packets(_dearmoured(content))))
    except (IndexError, ValueError, binascii.Error) as problem:
        raise NotAKey(str(problem)) from problem


def _dearmoured(content: bytes) -> bytes:
    if not content.lstrip().startswith(b"-----BEGIN"):
        return content
    text = content.decode("ascii", errors="replace").replace("\r", "")
    inner = re.search(r"-----\n(?:[^\n]+: [^\n]*\n)*\n(.*?)(?:\n=[\w+/]{4})?\n-----END", text, re.S)
    if inner is None:
        raise ValueError("damaged armour")
    return base64.b64decode(inner.group(1))


def _packets(content: bytes) -> Iterator[Packet]:
    place = 0
    while place < len(content):
        head = content[place]
        if not head & 0x80:
            raise ValueError("not a packet")
        if head & 0x40:
            tag = head & 0x3F
            length, start = _new_length(content, place + 1)
        else:
            tag = head >> 2 & 0x0F
            size = 1 << (head & 3)
            start = place + 1 + size
            length = int.from_bytes(content[place + 1 : start], "big")
        yield Packet(tag, content[start : start + length])
        place = start + length


def _new_length(content: bytes, place: int) -> tuple[int, int]:
    first = content[place]
    if first < 192:
        return first, place + 1
    if first < 224:
        return (first - 192 << 8) + content[place + 1] + 192, place + 2
    return int.from_bytes(content[place + 1 : place + 5], "big"), place + 5


def _ends(packets: list[Packet]) -> float | None:
    if not packets or packets[0].tag != PUBLIC_KEY:
        raise ValueError("no public key")
    made = int.from_bytes(packets[0].body[1:5], "big")
    newest, life = 0, 0
    for packet in packets[1:]:
        if packet.tag == SIGNATURE and packet.body[0] == 4:
            signed, seconds = _key_life(packet.body)
            if seconds is not None and signed >= newest:
                newest, life = signed, seconds
        elif packet.tag == PUBLIC_KEY:
            break  # the next key of the ring
    return float(made + life) if life else None


def _key_life(body: bytes) -> tuple[int, int | None]:
    """Return when a signature was made, and the key's life in seconds where it says one."""
    end = 6 + int.from_bytes(body[4:6], "big")
    place, signed, life = 6, 0, None
    while place < end:
        length, start = _new_length(body, place)
        kind, value = body[start] & 0x7F, body[start + 1 : start + length]
        if kind == CREATED:
            signed = int.from_bytes(value, "big")
        elif kind == KEY_LIFE:
            life = int.from_bytes(value, "big")
        place = start + length
    return signed, life
