"""`ros2 doctor hello`: whether computers hear each other, by ROS and by multicast."""

from __future__ import annotations

from typing import Any

from ros2_on_pip.words import CommandParser, positive, rate

TOPIC = "/canyouhearme"


def parser_for(command: str) -> CommandParser:
    """The options; `command` is doctor, or wtf."""
    about = "Check network connectivity between multiple hosts"
    parser = CommandParser(prog=f"ros2 {command} hello", description=about)
    parser.add_argument(
        "-t", "--topic", default=TOPIC, help=f"Name of ROS topic to publish to (default: {TOPIC})"
    )
    parser.add_argument(
        "-ep",
        "--emit-period",
        metavar="N",
        type=rate,
        default=0.1,
        help="Seconds between two messages (default: 0.1)",
    )
    parser.add_argument(
        "-pp",
        "--print-period",
        metavar="N",
        type=rate,
        default=1.0,
        help="Seconds between two tables (default: 1.0)",
    )
    parser.add_argument(
        "--ttl", type=positive, metavar="N", help="How many routers a packet may pass, plus one"
    )
    parser.add_argument("-1", "--once", action="store_true", help="Send for one period, then exit")
    return parser


def run(command: str, words: list[str]) -> int:
    """`ros2 COMMAND hello WORD...`."""
    options: Any = parser_for(command).parse_args(words)
    from ros2_on_pip.hello import greet

    return greet(options)
