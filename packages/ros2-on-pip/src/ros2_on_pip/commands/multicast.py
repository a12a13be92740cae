"""`ros2 multicast`: whether a datagram for many reaches this computer, or leaves it."""

from __future__ import annotations

import argparse
import ipaddress

from ros2_on_pip.words import OK, Verbs, positive

LARGEST_PORT = 65535


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    from ros2_on_pip.multicast import GROUP, PORT

    verbs = Verbs(command)
    receive = verbs("receive", "Receive a single UDP multicast packet", receive_one)
    send = verbs("send", "Send a single UDP multicast packet", send_one)
    for verb in (receive, send):
        verb.add_argument(
            "--group",
            type=group,
            default=GROUP,
            metavar="ADDRESS",
            help=f"The multicast group (default: {GROUP})",
        )
        verb.add_argument(
            "--port", type=port, default=PORT, metavar="N", help=f"The port (default: {PORT})"
        )
    send.add_argument(
        "--ttl", type=positive, metavar="N", help="How many routers the packet may pass, plus one"
    )


def group(text: str) -> str:
    """The address of a multicast group, for argparse."""
    try:
        if ipaddress.IPv4Address(text).is_multicast:
            return text
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"{text} is no multicast group: 224.0.0.0 to 239.255.255.255")


def port(text: str) -> int:
    """A UDP port, for argparse."""
    number = positive(text)
    if number > LARGEST_PORT:
        raise argparse.ArgumentTypeError(f"{text} is no port: they end at {LARGEST_PORT}")
    return number


def receive_one(options: argparse.Namespace) -> int:
    """`ros2 multicast receive`."""
    from ros2_on_pip.multicast import MulticastReceiver

    with MulticastReceiver(options.group, options.port) as receiver:
        print("Waiting for UDP multicast datagram...")
        text, (host, sender) = receiver.hear()
    print(f"Received from {host}:{sender}: '{text}'")
    return OK


def send_one(options: argparse.Namespace) -> int:
    """`ros2 multicast send`."""
    from ros2_on_pip.multicast import MulticastSender

    print("Sending one UDP multicast datagram...")
    with MulticastSender(options.group, options.port, options.ttl) as multicast_sender:
        multicast_sender.send("Hello World!")
    return OK
