"""Two hosts inside the arena: two networks of their own, joined by a link that is not a good one.

Nothing of it can be seen from outside: not from the machine, and not from the other experiments,
which share one network. A host is no more than a network namespace, held by a descriptor; a thread
enters it for as long as it starts something there. The link has two ends of the kind `tun`, where
the kernel hands packets to a program and takes them from it: tun(4), Documentation/networking/
tuntap.rst. It needs /dev/net/tun, and rights in the arena's user namespace; where the kernel
refuses either, `NoHosts` says so.
"""

from __future__ import annotations

import fcntl
import json
import os
import socket
import struct
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from roslings.arena import kernel
from roslings.arena.environment import HERE, LOSSY_LINK, MIDDLEWARE

TUN = Path("/dev/net/tun")
LINK = HERE / "link.py"
DEVICE = "link0"
ADDRESSES = ("10.20.30.1", "10.20.30.2")
NETMASK = "255.255.255.0"
_TUNSETIFF, _IFF_TUN_NO_PI = 0x400454CA, 0x0001 | 0x1000
_SIOCSIFADDR, _SIOCSIFDSTADDR, _SIOCSIFNETMASK, _SIOCSIFFLAGS = 0x8916, 0x8918, 0x891C, 0x8914
_IFF_UP_POINTOPOINT_RUNNING = 0x1 | 0x10 | 0x40
ENDS_WITHIN_S = 5.0
T = TypeVar("T")


class NoHosts(Exception):
    """There can be no two hosts here, and why; no fault of the student's."""


@dataclass(frozen=True)
class Host:
    """One computer: a network of its own, with an address on the link."""

    name: str
    address: str
    peer: str
    """The address of the other host."""
    network: int
    """An open descriptor of its network namespace."""

    @property
    def environment(self) -> dict[str, str]:
        """What every node on this host is told beside its domain.

        No multicast reaches the other host, so its address is told: ROS_STATIC_PEERS.
        """
        return {
            "RMW_IMPLEMENTATION": MIDDLEWARE,
            "FASTRTPS_DEFAULT_PROFILES_FILE": str(LOSSY_LINK),
            "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4",
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET",
            "ROS_STATIC_PEERS": self.peer,
        }

    @contextmanager
    def entered(self) -> Iterator[None]:
        """This thread is on the host: the processes that it starts, and its new sockets, are, too.

        Other threads stay where they are: setns(2).
        """
        home = _own_network()
        try:
            kernel.enter_network(self.network)
            try:
                yield
            finally:
                kernel.enter_network(home)
        finally:
            os.close(home)


class HostLink:
    """What joins the two hosts. A context manager: leaving the block ends it."""

    def __init__(self, ends: tuple[int, int], delay_s: float, loss: float, seed: int) -> None:
        """`ends` are open tun devices; `loss` is a part of all packets."""
        self._ends = ends
        self._words = [str(delay_s), str(loss), str(seed)]

    def __enter__(self) -> HostLink:
        self._control, theirs = socket.socketpair()
        with theirs:
            words = [*map(str, self._ends), str(theirs.fileno()), *self._words]
            self._process = subprocess.Popen(
                [sys.executable, "-I", "-S", str(LINK), *words],
                pass_fds=[*self._ends, theirs.fileno()],
                stdin=subprocess.DEVNULL,
                env={},
            )
        return self

    def __exit__(self, *error: object) -> None:
        self._control.close()
        try:
            self._process.wait(ENDS_WITHIN_S)
        finally:
            self._process.kill()
            self._process.wait()

    def cut(self) -> None:
        """From now on nothing passes."""
        self._control.sendall(b"cut\n")

    def mend(self) -> None:
        """From now on it is as it was at first."""
        self._control.sendall(b"mend\n")

    def counts(self) -> Mapping[str, int]:
        """Packets so far: `passed`, `lost` on the way, `multicast`, and lost while it was `cut`."""
        self._control.sendall(b"count\n")
        answer = b""
        while not answer.endswith(b"\n"):
            answer += self._control.recv(4096)
        return dict(json.loads(answer))


@dataclass(frozen=True)
class Hosts:
    """Two computers and the link between them."""

    first: Host
    second: Host
    link: HostLink


@contextmanager
def two_hosts(
    names: tuple[str, str], delay_s: float, loss: float, seed: int = 0
) -> Iterator[Hosts]:
    """Two hosts, gone with the block. Raises NoHosts.

    >>> with two_hosts(("laptop", "rover"), delay_s=0.02, loss=0.1) as hosts:
    ...     with hosts.second.entered():
    ...         subprocess.run(["ping", "-c1", hosts.first.address])
    """
    with ExitStack() as stack:
        try:
            made = [_made(address, peer) for address, peer in (ADDRESSES, ADDRESSES[::-1])]
        except OSError as error:
            raise NoHosts(f"this computer cannot play two computers ({error})") from error
        for network, end in made:
            stack.callback(os.close, network)
            stack.callback(os.close, end)
        link = stack.enter_context(HostLink((made[0][1], made[1][1]), delay_s, loss, seed))
        first, second = (
            Host(name, ADDRESSES[at], ADDRESSES[1 - at], made[at][0])
            for at, name in enumerate(names)
        )
        yield Hosts(first, second, link)


# --- one host ----------------------------------------------------------------------------------


def _made(address: str, peer: str) -> tuple[int, int]:
    """A network of its own, and the end of the link that is in it. Raises OSError."""
    return _in_a_thread(lambda: _make(address, peer))


def _make(address: str, peer: str) -> tuple[int, int]:
    """In a thread of its own, which leaves our network for good."""
    kernel.unshare(kernel.CLONE_NEWNET)
    kernel.raise_loopback()
    end = _open_end()
    try:
        _set_up(address, peer)
        return _own_network(), end
    except OSError:
        os.close(end)
        raise


def _open_end() -> int:
    """A new tun device of this network: what is read from it is what the kernel sends there."""
    end = os.open(TUN, os.O_RDWR | os.O_NONBLOCK | os.O_CLOEXEC)
    try:
        fcntl.ioctl(end, _TUNSETIFF, struct.pack("16sH14x", DEVICE.encode(), _IFF_TUN_NO_PI))
    except OSError:
        os.close(end)
        raise
    return end


def _set_up(address: str, peer: str) -> None:
    """Give the device its address, and bring it up: netdevice(7)."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as control:
        pairs = ((_SIOCSIFADDR, address), (_SIOCSIFDSTADDR, peer), (_SIOCSIFNETMASK, NETMASK))
        for request, dotted in pairs:
            name = struct.pack("=HH4s8x", socket.AF_INET, 0, socket.inet_aton(dotted))
            fcntl.ioctl(control, request, struct.pack("16s16s", DEVICE.encode(), name))
        flags = struct.pack("16sH14x", DEVICE.encode(), _IFF_UP_POINTOPOINT_RUNNING)
        fcntl.ioctl(control, _SIOCSIFFLAGS, flags)


def _own_network() -> int:
    """A descriptor of the network that this thread is in. Raises OSError."""
    return os.open("/proc/thread-self/ns/net", os.O_RDONLY | os.O_CLOEXEC)


def _in_a_thread(errand: Callable[[], T]) -> T:
    """What a new thread makes of it, which is gone then. Raises OSError."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(errand).result()
