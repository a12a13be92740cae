"""Becomes a program in a network where only loopback exists: `loopback_only.py WORD...`.

For what is said to many hosts at once: nothing of it leaves this process and its children.
"""

import ctypes
import fcntl
import os
import socket
import struct
import sys
from pathlib import Path

NEW_USER, NEW_NETWORK = 0x10000000, 0x40000000
SET_FLAGS, UP, MULTICAST = 0x8914, 0x1, 0x1000
"""SIOCSIFFLAGS, IFF_UP and IFF_MULTICAST, of netdevice(7)."""
ADD_ROUTE, IS_UP = 0x890B, 0x1
"""SIOCADDRT and RTF_UP, of Linux's <linux/route.h>."""
ROUTE = "L16s16s16sHhLPhPLLH"
"""Its `struct rtentry`: destination, gateway and mask are the three addresses."""


def address(dotted: str) -> bytes:
    """As `struct sockaddr_in` holds it."""
    return struct.pack("HH4s8x", socket.AF_INET, 0, socket.inet_aton(dotted))


def bring_up_loopback() -> None:
    """With a way to all groups."""
    name = ctypes.create_string_buffer(b"lo")
    where = (address("224.0.0.0"), address("0.0.0.0"), address("240.0.0.0"))
    route = struct.pack(ROUTE, 0, *where, IS_UP, 0, 0, 0, 0, ctypes.addressof(name), 0, 0, 0)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as control:
        fcntl.ioctl(control, SET_FLAGS, struct.pack("16sH14x", b"lo", UP | MULTICAST))
        fcntl.ioctl(control, ADD_ROUTE, route)


if __name__ == "__main__":
    user, group = os.getuid(), os.getgid()
    if ctypes.CDLL(None, use_errno=True).unshare(NEW_USER | NEW_NETWORK):
        sys.exit(os.strerror(ctypes.get_errno()))
    for name, words in (
        ("setgroups", "deny"),
        ("uid_map", f"{user} {user} 1"),
        ("gid_map", f"{group} {group} 1"),
    ):
        Path("/proc/self", name).write_text(words)
    bring_up_loopback()
    os.execv(sys.argv[1], sys.argv[1:])
