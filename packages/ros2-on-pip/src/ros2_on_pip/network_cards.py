"""The network cards of this computer, as the kernel tells of them."""

from __future__ import annotations

import array
import fcntl
import socket
import struct
from dataclasses import dataclass
from ipaddress import IPv6Address
from pathlib import Path

_ADDRESSES, _FLAGS, _BROADCAST, _NETMASK = 0x8912, 0x8913, 0x8919, 0x891B
"""What the kernel is asked for a card (SIOCGIFCONF and its kin)."""

_NAME_BYTES = 16
_ROOM_BYTES = 1 << 16
_REQUEST_BYTES = 40
FLAGS = (
    "up",
    "broadcast",
    "debug",
    "loopback",
    "pointopoint",
    "notrailers",
    "running",
    "noarp",
    "promisc",
    "allmulti",
    "master",
    "slave",
    "multicast",
)
"""The bits of a card's flags, the lowest first."""

NO_ADDRESS = "00:00:00:00:00:00"


@dataclass(frozen=True)
class NetworkCard:
    """A network card: its name, its flags, and its addresses."""

    name: str
    flags: tuple[str, ...]
    mtu: str
    ether: str
    inet4: tuple[str, ...]
    netmask: str
    broadcast: str
    inet6: tuple[str, ...]


def cards() -> list[NetworkCard]:
    """Every card, in the kernel's order. Raises OSError."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        addresses = _addresses(asked)
        return [_card(asked, name, addresses.get(name, ())) for _, name in socket.if_nameindex()]


def _card(asked: socket.socket, name: str, inet4: tuple[str, ...]) -> NetworkCard:
    bits = struct.unpack_from("H", _answer(asked, _FLAGS, name), _NAME_BYTES)[0]
    ether = _said(name, "address")
    return NetworkCard(
        name,
        tuple(flag for at, flag in enumerate(FLAGS) if bits >> at & 1),
        _said(name, "mtu"),
        "" if ether == NO_ADDRESS else ether,
        inet4,
        _address(asked, _NETMASK, name) if inet4 else "",
        _address(asked, _BROADCAST, name) if inet4 and bits & 1 << FLAGS.index("broadcast") else "",
        _inet6(name),
    )


def _answer(asked: socket.socket, what: int, name: str) -> bytes:
    return fcntl.ioctl(asked.fileno(), what, struct.pack("256s", name.encode()[: _NAME_BYTES - 1]))


def _address(asked: socket.socket, what: int, name: str) -> str:
    try:
        answer = _answer(asked, what, name)
    except OSError:
        return ""
    return socket.inet_ntoa(answer[_NAME_BYTES + 4 : _NAME_BYTES + 8])


def _addresses(asked: socket.socket) -> dict[str, tuple[str, ...]]:
    """Name of a card to its IPv4 addresses, those of its aliases too."""
    room = array.array("B", bytes(_ROOM_BYTES))
    request = struct.pack("iL", _ROOM_BYTES, room.buffer_info()[0])
    filled = struct.unpack("iL", fcntl.ioctl(asked.fileno(), _ADDRESSES, request))[0]
    found: dict[str, tuple[str, ...]] = {}
    for at in range(0, filled, _REQUEST_BYTES):
        one = room[at : at + _REQUEST_BYTES].tobytes()
        name = one[:_NAME_BYTES].partition(b"\0")[0].decode().partition(":")[0]
        address = socket.inet_ntoa(one[_NAME_BYTES + 4 : _NAME_BYTES + 8])
        found[name] = (*found.get(name, ()), address)
    return found


def _inet6(card: str) -> tuple[str, ...]:
    """Its IPv6 addresses: the first and the last word of each line of the kernel's table."""
    try:
        lines = Path("/proc/net/if_inet6").read_text("ascii").splitlines()
    except OSError:
        return ()
    parted = (line.split() for line in lines)
    return tuple(str(IPv6Address(int(w[0], 16))) for w in parted if w and w[-1] == card)


def _said(card: str, what: str) -> str:
    try:
        return Path("/sys/class/net", card, what).read_text("ascii").strip()
    except OSError:
        return ""
