"""Says hello by ROS and by multicast, and counts by computer who else does."""

from __future__ import annotations

import argparse
import socket
import time
from collections import Counter
from collections.abc import Iterable
from typing import Any

from ros2_on_pip.discovery import DirectNode
from ros2_on_pip.multicast import GROUP, PORT, MulticastReceiver, MulticastSender
from ros2_on_pip.names import checked_topic
from ros2_on_pip.words import OK


class GreetingTable:
    """How often who was heard, since the last time that it was printed."""

    def __init__(self, own: str) -> None:
        """`own` is the name of this computer, whose words do not count."""
        self._own = own
        self.clear()

    def clear(self) -> None:
        """Begin anew."""
        self.said = self.sent = 0
        self.by_ros: Counter[str] = Counter()
        self.by_multicast: Counter[str] = Counter()

    def count(self, counter: Counter[str], texts: Iterable[str]) -> None:
        """The last word of each greeting is the computer that it came from."""
        hosts = [text.split()[-1] for text in texts if text.split()]
        counter.update(host for host in hosts if host != self._own)

    def lines(self, topic: str, period_s: float) -> list[str]:
        """The table of the real tool."""
        return [
            "MULTIMACHINE COMMUNICATION SUMMARY",
            f"Topic: {topic}, Published Msg Count: {self.said}",
            "Subscribed from:",
            *_rows(self.by_ros, period_s),
            f"Multicast Group/Port: {GROUP}/{PORT}, Sent Msg Count: {self.sent}",
            "Received from:",
            *_rows(self.by_multicast, period_s),
            "-" * 60,
        ]


def _rows(counter: Counter[str], period_s: float) -> list[str]:
    rows = [("Hostname", f"Msg Count /{period_s}s"), *counter.items()]
    return [f"{'':<15} {host:<20} {count:<10}" for host, count in rows]


def greet(options: argparse.Namespace) -> int:
    """Say hello until Ctrl-C, or once. Raises NoMulticast."""
    from std_msgs.msg import String

    host, topic = socket.gethostname(), checked_topic(options.topic)
    table = GreetingTable(host)
    with (
        DirectNode(speaks=True) as direct_node,
        MulticastReceiver(GROUP, PORT) as receiver,
        MulticastSender(GROUP, PORT, options.ttl) as sender,
    ):
        publisher = direct_node.node.create_publisher(String, topic, 10)
        direct_node.node.create_subscription(
            String, topic, lambda message: table.count(table.by_ros, [message.data]), 10
        )

        def say() -> None:
            publisher.publish(String(data=f"hello, it's me {host}"))
            sender.send(f"hello, it's me {host}")
            table.said, table.sent = table.said + 1, table.sent + 1

        _go_on(direct_node, receiver, table, say, options, topic)
    return OK


def _go_on(
    direct_node: DirectNode,
    receiver: MulticastReceiver,
    table: GreetingTable,
    say: Any,
    options: argparse.Namespace,
    topic: str,
) -> None:
    printed_s = time.monotonic()
    while True:
        say()
        direct_node.spin_to(time.monotonic() + options.emit_period)
        table.count(table.by_multicast, receiver.waiting())
        if options.once or time.monotonic() - printed_s >= options.print_period:
            print("\n".join(table.lines(topic, options.print_period)))
            table.clear()
            printed_s = time.monotonic()
        if options.once:
            return
