"""Where a kernel stands: its ROS domain, which no other notebook of this computer uses.

Two notebooks that are open at once would hear each other's nodes. So each kernel leases its domain
as an arena does, by a bound TCP port on loopback. The kernel of the operating system takes it back
when the process ends, however it ends.
"""

from __future__ import annotations

import os
import socket
import sys
from pathlib import Path

from ros2_on_pip.surroundings import domain_id, prepare
from roslings_learn.of_window import wanted_or_next

LOGS_ON_STDOUT = "RCUTILS_LOGGING_USE_STDOUT"
LOGS = {LOGS_ON_STDOUT: "1", "RCUTILS_LOGGING_BUFFERED_STREAM": "0"}
"""A node's log lines stand among the cell's other output, and not in red as an error does."""

ON_THE_SITE = "ROSLINGS_SITE"
"""Set where the website runs a lesson: the quiz has a page of its own there, for example."""

OWN_DOMAIN = "ROSLINGS_OWN_DOMAIN"
"""Set with ROS_DOMAIN_ID where nobody chose that one: see `domain.sh` of roslings-launcher."""

_held: dict[int, socket.socket] = {}
"""The domain of this process, with its lease; empty until a cell first needs it."""


def settle_in() -> int:
    """The ROS domain of this kernel. The first call leases it and fills in the environment.

    Raises NoFreeDomain, BadDomain (ROS_DOMAIN_ID is no number).
    """
    if not _held:
        _fill_in()
        domain, held = _lease(domain_id())
        _held[domain] = held
    return next(iter(_held))


def on_the_site() -> bool:
    """The website is built, and nobody sits before this notebook."""
    return bool(os.environ.get(ON_THE_SITE))


def _fill_in() -> None:
    prepare()
    for name, value in LOGS.items():
        os.environ.setdefault(name, value)
    path = os.environ.get("PATH", os.defpath).split(os.pathsep)
    own = str(Path(sys.executable).parent)
    if own not in path:
        os.environ["PATH"] = os.pathsep.join([own, *path])


def _lease(wanted: int) -> tuple[int, socket.socket]:
    domain, held = wanted_or_next(wanted)
    if domain == wanted:
        _tell_who_came_by_a_hub(wanted)
    else:
        _tell(wanted, domain)
    return domain, held


def _tell_who_came_by_a_hub(domain: int) -> None:
    """Everybody else has seen the line in the terminal in which `./roslings lab` was typed."""
    if "JUPYTERHUB_USER" in os.environ and os.environ.get(OWN_DOMAIN) == str(domain):
        print(f"Several people use this computer, so your ROS_DOMAIN_ID is {domain}.")


def _tell(wanted: int, domain: int) -> None:
    """Children of this kernel go along; a terminal must be told by its person."""
    os.environ["ROS_DOMAIN_ID"] = str(domain)
    print(
        f"Another notebook uses ROS domain {wanted}, so this one uses {domain}."
        f" In a terminal, to see its nodes: export ROS_DOMAIN_ID={domain}"
    )
