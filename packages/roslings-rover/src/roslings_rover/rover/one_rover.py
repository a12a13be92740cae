"""Never two rovers on one /cmd_vel, where one of them belongs to a cell of a notebook.

What a cell measures would be wrong beside a second rover, and nobody would see why. Two rovers in
two terminals tell it on their maps, and stay. Each rover has a socket with a name that Linux lists
(unix(7), abstract names): it goes with its process, and leaves no file.
"""

from __future__ import annotations

import itertools
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ros2_on_pip.surroundings import domain_id
from roslings_rover.errors import DeviceTrouble

LISTED = Path("/proc/net/unix")
IN_CELL, IN_TERMINAL = "cell", "terminal"

_numbers = itertools.count()


class RoverThere(DeviceTrouble):
    """A rover runs already, and a cell wants one."""

    def __init__(self, domain: int) -> None:
        super().__init__(
            f"A rover runs in ROS domain {domain} already, and two would follow one /cmd_vel."
            " End the other one: with Ctrl-C in its terminal, or by restarting the kernel of its"
            " notebook. Then run this cell again."
        )


class RoverInCell(DeviceTrouble):
    """A cell's rover runs, and a terminal wants one."""

    def __init__(self, domain: int) -> None:
        super().__init__(
            f"A cell of a notebook runs a rover in ROS domain {domain}, and two would follow one"
            " /cmd_vel. Wait until the cell has ended, or stop it. Then type the command again."
        )


@contextmanager
def rover_of_cell() -> Iterator[None]:
    """No other rover runs beside this one while the block does. Raises RoverThere, BadDomain."""
    domain = domain_id()
    with _named(domain, IN_CELL) as own:
        if set(_there(domain)) - {own}:
            raise RoverThere(domain)
        yield


@contextmanager
def rover_of_terminal() -> Iterator[None]:
    """No cell's rover runs beside this one while the block does. Raises RoverInCell, BadDomain."""
    domain = domain_id()
    with _named(domain, IN_TERMINAL):
        if any(f"-{IN_CELL}-" in name for name in _there(domain)):
            raise RoverInCell(domain)
        yield


@contextmanager
def _named(domain: int, kind: str) -> Iterator[str]:
    """Who begins at the same moment sees this, too: the name is there before anybody looks."""
    name = f"{_of(domain)}{kind}-{os.getpid()}-{next(_numbers)}"
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as held:
        held.bind(f"\0{name}")
        yield name


def _there(domain: int) -> Iterator[str]:
    """The names of all rovers of this user in the domain; none where Linux does not list them."""
    try:
        lines = LISTED.read_text("utf-8", "replace").splitlines()
    except OSError:
        return
    mark = f"@{_of(domain)}"
    yield from (line.split()[-1][1:] for line in lines if mark in line)


def _of(domain: int) -> str:
    return f"roslings-rover-{os.getuid()}-{domain}-"
