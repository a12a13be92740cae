"""How many programs take part in a ROS domain on this computer, as the kernel knows it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

PORT_BASE, PORTS_PER_DOMAIN, FIRST, PORTS_EACH = 7400, 250, 10, 2
"""DDSI-RTPS 9.6.1.4: participant p of domain d listens on port 7400 + 250 d + 10 + 2 p."""

TABLES = ("/proc/net/udp", "/proc/net/udp6")


def participants_here(domain: int) -> frozenset[int]:
    """The ports of `domain`'s participants on this computer, our own among them.

    The kernel shows its table piece by piece: while other programs open and close sockets, one
    reading can lack a port that was there all the time. Never believe a single reading.
    """
    first = PORT_BASE + PORTS_PER_DOMAIN * domain + FIRST
    last = PORT_BASE + PORTS_PER_DOMAIN * (domain + 1)
    return frozenset(port for port in _ports() if port in range(first, last, PORTS_EACH))


def _ports() -> Iterator[int]:
    for table in TABLES:
        try:
            lines = Path(table).read_text("ascii").splitlines()[1:]
        except OSError:
            continue
        yield from (int(line.split()[1].rpartition(":")[2], 16) for line in lines)
