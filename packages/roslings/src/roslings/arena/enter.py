"""Script: run a command in a network of its own, where only loopback exists.

    python -I -S enter.py COMMAND ...    become COMMAND inside
    python -I -S enter.py --try          say `ok`, or why this machine refuses (exit 97)
    python -I -S enter.py --room FOLDER BYTES COMMAND ...
                                         become COMMAND inside, with terminals of its own, and a
                                         FOLDER that holds so much and is gone with the last process
    python -I -S enter.py --room FOLDER BYTES --other UID VIEW [--show SOURCE TARGET]... COMMAND ...
                                         besides, as root: the user UID is there too, and in VIEW
                                         each TARGET shows what lies at SOURCE

It runs in a bare interpreter, because a process with threads may not make a user namespace.
"""

from __future__ import annotations

import os
import socket
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # noqa: PTH100, PTH120
import kernel  # type: ignore[import-not-found]

REFUSED = 97
MULTICAST_GROUP = "239.255.0.1"


def main(arguments: list[str]) -> None:
    """Enter, then try it or become the command."""
    try:
        if arguments[0] == "--room":
            arguments = enter_with_room(arguments[1], int(arguments[2]), arguments[3:])
        else:
            kernel.enter()
        if arguments == ["--try"]:
            try_namespaces()
            print("ok")
            return
    except OSError as error:
        print(error.strerror or error, file=sys.stderr)
        sys.exit(REFUSED)
    os.execvp(arguments[0], arguments)


def enter_with_room(folder: str, most_bytes: int, rest: list[str]) -> list[str]:
    """Enter, and show what is to be seen; what is left of the words. Raises OSError."""
    if rest[0] != "--other":
        kernel.enter_with_room(folder, most_bytes)
        return rest
    kernel.enter_with_room(folder, most_bytes, int(rest[1]), rest[2])
    rest = rest[3:]
    while rest[0] == "--show":
        kernel.show(rest[1], rest[2])
        rest = rest[3:]
    return rest


def try_namespaces() -> None:
    """Prove that multicast comes back on loopback, and that a guardian's namespaces nest."""
    import guardian  # type: ignore[import-not-found]

    hear_oneself()
    guardian.enter_namespaces()


def hear_oneself() -> None:
    """Send one datagram to a multicast group and receive it. Raises OSError."""
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender,
    ):
        receiver.bind(("", 0))
        group = socket.inet_aton(MULTICAST_GROUP) + socket.inet_aton("127.0.0.1")
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
        receiver.settimeout(5.0)
        sender.sendto(b"hello", (MULTICAST_GROUP, receiver.getsockname()[1]))
        receiver.recv(16)


if __name__ == "__main__":
    main(sys.argv[1:])
