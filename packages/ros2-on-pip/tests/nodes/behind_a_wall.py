"""Runs in a network of its own: one `ros2` hears, another speaks; what both print is printed.

behind_a_wall.py pair RECEIVE_WORD... -- SEND_WORD...
behind_a_wall.py ttl SEND_WORD...
behind_a_wall.py tables HELLO_WORD...
"""

from __future__ import annotations

import os
import socket
import struct
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[4] / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from terminal import Running, ours

GROUP, PORT = "225.0.0.1", 49150
IP_RECVTTL = 12
"""Of Linux's <netinet/in.h>; Python's own name for it is newer than 3.13."""


def pair(words: list[str]) -> None:
    """What the receiver prints, and then the sender."""
    cut = words.index("--")
    hearing = Running(ours("multicast", "receive", *words[:cut]), dict(os.environ), Path.cwd())
    try:
        hearing.wait_for("Waiting for UDP multicast datagram")
        sent = subprocess.run(
            ours("multicast", "send", *words[cut + 1 :]), capture_output=True, text=True, check=True
        )
        hearing.wait_for("Received from")
        print(f"{hearing.text}\n{sent.stdout}", end="")
    finally:
        hearing.end()


def ttl(words: list[str]) -> None:
    """How many networks a datagram of `ros2 WORD...` may reach, as its receiver sees it."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
        receiver.bind((GROUP, PORT))
        receiver.setsockopt(socket.IPPROTO_IP, IP_RECVTTL, 1)
        membership = struct.pack("4sl", socket.inet_aton(GROUP), socket.INADDR_ANY)
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
        subprocess.run(ours(*words), stdout=subprocess.DEVNULL, check=True)
        _, about, _, _ = receiver.recvmsg(100, 100)
        print("ttl", next(data[0] for _, kind, data in about if kind == socket.IP_TTL))


def tables(words: list[str]) -> None:
    """The first tables of `ros2 wtf hello`, one slow and one quick."""
    hello = Running(ours("wtf", "hello", *words), dict(os.environ), Path.cwd())
    try:
        hello.wait_for("^-{60}$", times=2)
        print(hello.text)
    finally:
        hello.end()


if __name__ == "__main__":
    {"pair": pair, "ttl": ttl, "tables": tables}[sys.argv[1]](sys.argv[2:])
