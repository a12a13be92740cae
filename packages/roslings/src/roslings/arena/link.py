"""Script: a bad link between two hosts. It delays packets, loses some, and passes no multicast.

    python -I -S link.py FD FD CONTROL DELAY_S LOSS SEED

The first two are the hosts' ends (tun devices), CONTROL is one end of a stream socket pair. On it
come the lines `cut`, `mend` and `count`; the answer to `count` is one line of JSON. When the other
end of it closes, the link is gone. Only UDP is lost: the rest is what a host needs to know the way.
"""

from __future__ import annotations

import heapq
import os
import random
import select
import sys
import time

PACKET_BYTES = 65536
IP_UDP = 17
FIRST_MULTICAST = 224


class EmulatedLink:
    """What is under way between two ends, and what was lost."""

    def __init__(self, ends: tuple[int, int], delay_s: float, loss: float, seed: int) -> None:
        """`loss` is a part of all packets of UDP; `seed` decides which."""
        self._other = {ends[0]: ends[1], ends[1]: ends[0]}
        self._delay_s, self._loss = delay_s, loss
        self._random = random.Random(seed)
        self._under_way: list[tuple[float, int, int, bytes]] = []
        self.is_cut = False
        self.counts = {"passed": 0, "lost": 0, "multicast": 0, "cut": 0}

    def take(self, end: int, now_s: float) -> None:
        """Take the packets that wait at one end."""
        while packet := _read(end):
            fate = self._fate(packet)
            self.counts[fate] += 1
            if fate == "passed":
                due = (now_s + self._delay_s, self.counts["passed"], self._other[end], packet)
                heapq.heappush(self._under_way, due)

    def _fate(self, packet: bytes) -> str:
        if self.is_cut:
            return "cut"
        if packet[0] >> 4 != 4 or packet[16] >= FIRST_MULTICAST:
            return "multicast"
        is_lost = packet[9] == IP_UDP and self._random.random() < self._loss
        return "lost" if is_lost else "passed"

    def deliver(self, now_s: float) -> None:
        """Hand over what has been under way for long enough."""
        while self._under_way and self._under_way[0][0] <= now_s:
            _, _, end, packet = heapq.heappop(self._under_way)
            try:
                os.write(end, packet)
            except OSError:  # its queue is full: a link may lose that, too
                self.counts["lost"] += 1

    def rests_s(self, now_s: float) -> float | None:
        """So long nothing is due; None where nothing is under way."""
        return max(0.0, self._under_way[0][0] - now_s) if self._under_way else None


def _read(end: int) -> bytes:
    try:
        return os.read(end, PACKET_BYTES)
    except BlockingIOError:
        return b""


def main(ends: tuple[int, int], control: int, delay_s: float, loss: float, seed: int) -> None:
    """Be the link, until the other end of `control` closes."""
    link = EmulatedLink(ends, delay_s, loss, seed)
    while True:
        ready, _, _ = select.select([*ends, control], [], [], link.rests_s(time.monotonic()))
        if control in ready and not _obey(link, control):
            return
        for end in set(ready) - {control}:
            link.take(end, time.monotonic())
        link.deliver(time.monotonic())


def _obey(link: EmulatedLink, control: int) -> bool:
    """Do what was said; whether somebody is still there."""
    words = os.read(control, PACKET_BYTES).split()
    for word in words:
        if word == b"count":
            told = ", ".join(f'"{name}": {number}' for name, number in link.counts.items())
            os.write(control, b"{%s}\n" % told.encode())
        else:
            link.is_cut = word == b"cut"
    return bool(words)


if __name__ == "__main__":
    one, other, control, delay_s, loss, seed = sys.argv[1:]
    main((int(one), int(other)), int(control), float(delay_s), float(loss), int(seed))
