"""The other end of a filter of system calls: each call that it asks of is refused, and counted.

Source: seccomp_unotify(2) and <linux/seccomp.h>. The guardian reads this, so it imports little.
"""

from __future__ import annotations

import _socket
import errno
import fcntl
import select
import sys

RECEIVE, SEND = 0xC0502100, 0xC0182101
"""SECCOMP_IOCTL_NOTIF_RECV and SECCOMP_IOCTL_NOTIF_SEND."""
QUESTION_BYTES, NUMBER_AT = 80, 16
"""Of `struct seccomp_notif`; it begins with what the answer has to name, in eight bytes."""
DESCRIPTOR_BYTES = 4


class Refusals:
    """Refuses calls, by number counted."""

    def __init__(self, asked: int | None) -> None:
        """`asked`: the filter's other end; None where nobody asks."""
        self.asked = asked
        self.counts: dict[str, int] = {}

    def sources(self) -> list[int]:
        """What to wait for."""
        return [] if self.asked is None else [self.asked]

    def answer(self) -> None:
        """Refuse the call that waits, where one does."""
        if self.asked is not None:
            poll = select.poll()
            poll.register(self.asked, select.POLLIN)
            ((_, events),) = poll.poll(0) or ((0, 0),)
            if events & select.POLLIN:
                self._refuse(self.asked)
            elif events:
                self.asked = None  # nobody is left who could call

    def _refuse(self, asked: int) -> None:
        question = bytearray(QUESTION_BYTES)
        try:
            fcntl.ioctl(asked, RECEIVE, question)
            number = str(int.from_bytes(question[NUMBER_AT : NUMBER_AT + 4], sys.byteorder))
            self.counts[number] = self.counts.get(number, 0) + 1
            value, error, flags = bytes(8), -errno.EPERM, bytes(4)
            refused = error.to_bytes(4, sys.byteorder, signed=True)
            fcntl.ioctl(asked, SEND, bytes(question[:8]) + value + refused + flags)
        except OSError:  # who asked has ended meanwhile
            return


def pair() -> tuple[_socket.socket, _socket.socket]:
    """To hand the filter's other end from a child to its parent."""
    return _socket.socketpair(_socket.AF_UNIX, _socket.SOCK_STREAM)


def hand_over(ours: _socket.socket, descriptor: int) -> None:
    """In the child: the parent gets a descriptor of it, too."""
    words = descriptor.to_bytes(DESCRIPTOR_BYTES, sys.byteorder)
    ours.sendmsg([b"\0"], [(_socket.SOL_SOCKET, _socket.SCM_RIGHTS, words)])


def taken_over(ours: _socket.socket) -> int | None:
    """In the parent: the descriptor, once it comes; None where the child has none."""
    _, ancillary, _, _ = ours.recvmsg(1, _socket.CMSG_SPACE(DESCRIPTOR_BYTES))
    for _, _, words in ancillary:
        return int.from_bytes(words[:DESCRIPTOR_BYTES], sys.byteorder)
    return None
