"""UDP datagrams for a multicast group: what DDS finds other computers with."""

from __future__ import annotations

import socket
import struct
from types import TracebackType

from ros2_on_pip.problem import CommandProblem

GROUP, PORT = "225.0.0.1", 49150
"""Those of the real tool."""

LONGEST = 4096


class NoMulticast(CommandProblem):
    """The network of this computer refuses."""

    def __init__(self, doing: str, group: str, fault: OSError) -> None:
        super().__init__(
            f"Multicast does not work here: {doing} {group}: {fault.strerror or fault}."
            " Is this computer on a network? To find out more: ros2 doctor"
        )


class _Socket:
    """A UDP socket; leaving the block closes it."""

    def __init__(self) -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._socket.close()


class MulticastSender(_Socket):
    """Sends to a group. A context manager."""

    def __init__(self, group: str, port: int, ttl: int | None = None) -> None:
        """`ttl` is the number of networks that a datagram may reach; by default the nearest."""
        super().__init__()
        self._group, self._port = group, port
        if ttl is not None:
            self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, min(ttl, 255))

    def __enter__(self) -> MulticastSender:
        return self

    def send(self, text: str) -> None:
        """Send one datagram. Raises NoMulticast."""
        try:
            self._socket.sendto(text.encode(), (self._group, self._port))
        except OSError as fault:
            raise NoMulticast("sending to", self._group, fault) from fault


class MulticastReceiver(_Socket):
    """Hears a group, beside others who do. A context manager."""

    def __init__(self, group: str, port: int) -> None:
        super().__init__()
        self._group, self._port = group, port

    def __enter__(self) -> MulticastReceiver:
        """Raises NoMulticast."""
        membership = struct.pack("4sl", socket.inet_aton(self._group), socket.INADDR_ANY)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
        try:
            self._socket.bind(("", self._port))
            self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
        except OSError as fault:
            self._socket.close()
            raise NoMulticast("joining", self._group, fault) from fault
        return self

    def hear(self) -> tuple[str, tuple[str, int]]:
        """One datagram, and the address and port it came from; waits for it."""
        raw, sender = self._socket.recvfrom(LONGEST)
        return raw.decode(errors="replace"), sender

    def waiting(self) -> list[str]:
        """Every datagram that has come; waits for none."""
        self._socket.setblocking(False)
        found = []
        try:
            while True:
                found.append(self.hear()[0])
        except BlockingIOError:
            return found
