"""What a window of JupyterLab gives the notebooks in it: its address, and its ROS domain.

A window leases its domain as an arena does, so that two windows of one computer are apart. Its
terminals are in it from the start. The first notebook that runs a cell is in it, too; the next one
of the same window gets another domain.
"""

from __future__ import annotations

import os
import socket

from ros2_on_pip.domain_lease import SAFE_DOMAINS, NoFreeDomain, domains_in_use, lease

OF_SERVER = "ROSLINGS_WINDOW"
"""Set for all that a window starts: the path that the server's addresses begin with."""

OF_WINDOW = "ROSLINGS_WINDOW_DOMAIN"
"""Set for all that a window starts: the domain that it holds."""


def wanted_or_next(wanted: int) -> tuple[int, socket.socket]:
    """A domain with its lease: `wanted` where nobody has it, else a free one.

    Raises NoFreeDomain.
    """
    busy = domains_in_use()
    for domain in (wanted, *(each for each in SAFE_DOMAINS if each not in busy)):
        held = _seat(domain) if _is_the_windows(domain) else lease(domain)
        if held is not None:
            return domain, held
    raise NoFreeDomain


def _is_the_windows(domain: int) -> bool:
    return os.environ.get(OF_WINDOW) == str(domain)


def _seat(domain: int) -> socket.socket | None:
    """The window holds the domain; this says which notebook of the window is in it."""
    held = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        held.bind(f"\0roslings-notebook-{domain}")
    except OSError:
        held.close()
        return None
    return held
