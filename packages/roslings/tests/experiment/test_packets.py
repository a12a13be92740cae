"""Reading along on the loopback: what real packets say, and what broken ones must not do."""

from __future__ import annotations

import random
import socket
import struct
import time

import pytest

from ros2_on_pip.rtps import PORTS_PER_DOMAIN, ports_of
from roslings.experiment.packets import (
    MOST_SAMPLES,
    SentSamples,
    rtps_of,
    samples_in,
    tapped,
)
from skips import skip_without

DOMAIN = 3
PORT = ports_of(DOMAIN)[11]
PARTICIPANT = bytes(range(12))
WRITER = b"\0\0\x12\x03"
ANNOUNCER = b"\0\0\3\xc2"
S = 10**9
PATIENCE_S = 60.0


def udp(payload: bytes, port: int = PORT) -> bytes:
    """An IPv4 packet, as the kernel hands it over."""
    head = struct.pack(
        "!BBHHHBBH4s4s",
        0x45,
        0,
        28 + len(payload),
        0,
        0,
        64,
        17,
        0,
        socket.inet_aton("127.0.0.1"),
        socket.inet_aton("127.0.0.1"),
    )
    return head + struct.pack("!HHHH", 40000, port, 8 + len(payload), 0) + payload


def data(
    writer: bytes, number: int, content: bytes, order: str = "<", inline: bytes = b""
) -> bytes:
    """An RTPS message with one DATA submessage (DDSI-RTPS 9.4.5.4)."""
    flags = (order == "<") | (0x02 if inline else 0) | 0x04
    body = struct.pack(f"{order}HH", 0, 16) + bytes(4) + writer
    body += struct.pack(f"{order}iI", number >> 32, number & 0xFFFFFFFF) + inline + content
    head = b"RTPS\x02\x03\x01\x0f" + PARTICIPANT
    return head + struct.pack(f"{order}BBH", 0x15, flags, len(body)) + body


def announcement(topic: str, order: str = "<") -> bytes:
    """A writer makes itself known."""
    name = topic.encode() + b"\0"
    name = struct.pack(f"{order}I", len(name)) + name
    name += bytes(-len(name) % 4)
    listed = struct.pack(f"{order}HH", 0x05, len(name)) + name
    listed += struct.pack(f"{order}HH", 0x5A, 16) + PARTICIPANT + WRITER
    return data(ANNOUNCER, 1, bytes(4) + listed + struct.pack(f"{order}HH", 1, 0), order)


@pytest.mark.parametrize("order", ["<", ">"])
def test_times_are_of_the_topic_alone(order: str) -> None:
    """Its writer's samples, each once, though it was sent again."""
    heard = SentSamples()
    heard.add(udp(announcement("rt/chatter", order)), DOMAIN, 0)
    for at, number in ((1, 1), (2, 2), (3, 2), (4, 3)):
        heard.add(udp(data(WRITER, number, b"\0\1\0\0", order)), DOMAIN, at * S)
    heard.add(udp(data(b"\0\0\x13\x03", 1, b"\0\1\0\0", order)), DOMAIN, 5 * S)
    assert heard.sent_ns("/chatter") == [1 * S, 2 * S, 4 * S]
    assert heard.sent_ns("/rosout") == []


def test_inline_settings_are_passed_over() -> None:
    """An announcement may have some before its list."""
    heard = SentSamples()
    inline = struct.pack("<HH4sHH", 0x71, 4, bytes(4), 1, 0)
    name = struct.pack("<I", 11) + b"rt/chatter\0\0"
    listed = struct.pack("<HH", 0x05, len(name)) + name
    listed += struct.pack("<HH", 0x5A, 16) + PARTICIPANT + WRITER + struct.pack("<HH", 1, 0)
    heard.add(udp(data(ANNOUNCER, 1, bytes(4) + listed, inline=inline)), DOMAIN, 0)
    heard.add(udp(data(WRITER, 7, b"\0\1\0\0")), DOMAIN, S)
    assert heard.sent_ns("/chatter") == [S]


def test_another_domain_and_another_protocol_are_not_ours() -> None:
    """On a machine without namespaces others speak on the same loopback."""
    assert rtps_of(udp(data(WRITER, 1, b""), PORT + PORTS_PER_DOMAIN), DOMAIN) == b""
    assert rtps_of(udp(b"GET / HTTP/1.1"), DOMAIN) == b""
    assert rtps_of(udp(data(WRITER, 1, b"")), DOMAIN).startswith(b"RTPS")


def test_no_packet_breaks_it() -> None:
    """Cut short, or with any byte changed: a forger may send what it likes."""
    dice = random.Random(5)
    whole = [udp(announcement("rt/chatter")), udp(data(WRITER, 1, b"\0\1\0\0"))]
    for packet in whole:
        for length in range(len(packet)):
            SentSamples().add(packet[:length], DOMAIN, 0)
        for _ in range(3000):
            changed = bytearray(packet)
            for place in dice.sample(range(len(packet)), 3):
                changed[place] = dice.randrange(256)
            SentSamples().add(bytes(changed), DOMAIN, 0)
    assert [*samples_in(b"RTPS" + b"\0" * 200)] == []


def test_a_flood_is_bounded() -> None:
    """Its beginning is kept: that tells its pace."""
    heard = SentSamples()
    heard.add(udp(announcement("rt/chatter")), DOMAIN, 0)
    for number in range(MOST_SAMPLES + 50):
        heard.add(udp(data(WRITER, number, b"")), DOMAIN, number)
    assert len(heard.sent_ns("/chatter")) == MOST_SAMPLES


def test_what_goes_over_the_loopback_is_heard() -> None:
    """With the kernel's own times; where it lets nobody read along, that is said."""
    with tapped(DOMAIN) as tap:
        if tap is None:
            skip_without("packets of the loopback")
        assert tap
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            sender.sendto(announcement("rt/chatter"), ("127.0.0.1", PORT))
            for number in (1, 2, 3):
                sender.sendto(data(WRITER, number, b"\0\1\0\0"), ("127.0.0.1", PORT))
        end_s = time.monotonic() + PATIENCE_S
        while len(tap.sent_ns("/chatter")) < 3 and time.monotonic() < end_s:
            time.sleep(0.01)
        sent_ns = tap.sent_ns("/chatter")
        assert sent_ns == sorted(sent_ns)
        assert len(sent_ns) == 3
        assert sent_ns[0] > 0
        assert tap.lost() == 0
