"""How many programs take part in a ROS domain on this computer, as the kernel knows it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ros2_on_pip.rtps import ports_of

FIRST, PORTS_EACH = 10, 2
"""DDSI-RTPS 9.6.1.4: participant p of domain d listens on port 7400 + 250 d + 10 + 2 p."""

HERE = "127.0.0.1"

TABLES = ("/proc/net/udp", "/proc/net/udp6")


def participants_here(domain: int) -> frozenset[int]:
    """The ports of `domain`'s participants on this computer, our own among them.

    The kernel shows its table piece by piece: while other programs open and close sockets, one
    reading can lack a port that was there all the time. Never believe a single reading.
    """
    return frozenset(port for port, _ in _sockets() if port in _of_domain(domain))


def own_participants(domain: int) -> frozenset[int]:
    """The ports of `domain`'s participants in this very process."""
    own = set(_own_inodes())
    return frozenset(p for p, inode in _sockets() if inode in own and p in _of_domain(domain))


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


def _own_inodes() -> Iterator[str]:
    """The inodes of this process's sockets: a link of /proc/self/fd is `socket:[INODE]`."""
    for link in Path("/proc/self/fd").iterdir():
        try:
            target = str(link.readlink())
        except OSError:  # closed in this moment
            continue
        if target.startswith("socket:["):
            yield target[len("socket:[") : -1]
