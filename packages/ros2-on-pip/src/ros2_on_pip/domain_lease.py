"""Lease a ROS domain that nobody else on this machine uses.

A lease is a bound TCP port on loopback. The kernel gives it to one process only, and takes it back
when that process ends, however it ends. It needs no file, so two users do not meet.
"""

from __future__ import annotations

import os
import random
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ros2_on_pip.errors import INCONCLUSIVE, RoslingsError
from ros2_on_pip.rtps import PORT_BASE, PORTS_PER_DOMAIN

SAFE_DOMAINS = range(1, 102)
"""0 is everybody's; above 101 DDS ports meet Linux's ephemeral ones (About-Domain-ID)."""

LEASE_PORT_BASE = 20200


class NoFreeDomain(RoslingsError):
    """Every domain of this machine is taken."""

    exit_status = INCONCLUSIVE

    def __init__(self) -> None:
        super().__init__(
            "All ROS domains of this machine are in use. End some nodes and try again."
        )


@contextmanager
def leased_domain() -> Iterator[int]:
    """A domain id of one's own, until the block ends. Raises NoFreeDomain."""
    busy = domains_in_use() | _own_domain()
    candidates = [domain for domain in SAFE_DOMAINS if domain not in busy]
    random.SystemRandom().shuffle(candidates)
    for domain in candidates:
        held = lease(domain)
        if held is not None:
            with held:
                yield domain
            return
    raise NoFreeDomain


def lease(domain: int) -> socket.socket | None:
    """This domain, for as long as the socket is open; None where somebody else has it."""
    held = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        held.bind(("127.0.0.1", LEASE_PORT_BASE + domain))
    except OSError:
        held.close()
        return None
    return held


def _own_domain() -> set[int]:
    """The domain that the student's own terminals use."""
    text = os.environ.get("ROS_DOMAIN_ID", "")
    return {int(text)} if text.isdecimal() else set()


def domains_in_use() -> set[int]:
    """Domains of nodes that run here: DDS listens on UDP port 7400 + 250 * domain and above."""
    try:
        lines = Path("/proc/net/udp").read_text("ascii").splitlines()[1:]
    except OSError:
        return set()
    ports = (int(line.split()[1].rpartition(":")[2], 16) for line in lines)
    return {(port - PORT_BASE) // PORTS_PER_DOMAIN for port in ports}
