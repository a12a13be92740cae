"""How many programs take part in a ROS domain on this computer, as the kernel knows it."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from ros2_on_pip.rtps import ports_of

FIRST, PORTS_EACH = 10, 2
"""DDSI-RTPS 9.6.1.4: participant p of domain d listens on port 7400 + 250 d + 10 + 2 p."""

HERE = "127.0.0.1"

TABLES = ("/proc/net/udp", "/proc/net/udp6")

BELIEVED_READINGS = 5
"""Who stood in none of the kernel's last readings has ended."""

ROOM_BYTES = 1 << 22
"""More than ten neighbours say of themselves in one moment; the kernel gives what it allows."""


def participants_here(domain: int) -> frozenset[int]:
    """The ports of `domain`'s participants on this computer, our own among them.

    The kernel shows its table piece by piece. While other programs open and close sockets, one
    reading can lack a port that was there all the time. Never believe a single reading.
    """
    return frozenset(port for port, _ in _sockets() if port in _of_domain(domain))


def own_participants(domain: int) -> frozenset[int]:
    """The ports of `domain`'s participants in this very process."""
    return frozenset(_own_sockets(domain))


def give_room(domain: int) -> None:
    """Let our own participants be told more in one moment than they can read in it.

    All neighbours introduce their endpoints at once. By default the kernel keeps some ninety
    datagrams of a socket; of ten nodes come a hundred. What finds no room is said again only a
    second later, with the next heartbeat.
    """
    for descriptor in _own_sockets(domain).values():
        with suppress(OSError), socket.socket(fileno=os.dup(descriptor)) as receiver:
            receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, ROOM_BYTES)


def _own_sockets(domain: int) -> dict[int, int]:
    """Port to descriptor."""
    own, ports = _own_inodes(), _of_domain(domain)
    return {port: own[inode] for port, inode in _sockets() if inode in own and port in ports}


def _of_domain(domain: int) -> range:
    return ports_of(domain)[FIRST::PORTS_EACH]


def _sockets() -> Iterator[tuple[int, str]]:
    """Port and inode of each UDP socket of this computer."""
    for table in TABLES:
        try:
            lines = Path(table).read_text("ascii").splitlines()[1:]
        except OSError:
            continue
        for words in map(str.split, lines):
            yield int(words[1].rpartition(":")[2], 16), words[9]


def _own_inodes() -> dict[str, int]:
    """The inodes of this process's sockets, and their descriptors.

    A link of /proc/self/fd is `socket:[INODE]`.
    """
    found = {}
    for link in Path("/proc/self/fd").iterdir():
        with suppress(OSError):  # closed in this moment
            target = str(link.readlink())
            if target.startswith("socket:["):
                found[target[len("socket:[") : -1]] = int(link.name)
    return found
