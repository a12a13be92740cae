"""`ros2 topic`: which topics there are, what is said on them, and saying something oneself."""

from __future__ import annotations

import argparse
import sys

from ros2_on_pip.habits import full_topic, full_type
from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.qos import add_qos_options
from ros2_on_pip.shared_options import (
    also_hidden,
    complete_interfaces,
    complete_type_of,
    complete_values,
    count_only,
    hidden_topics,
    node_options,
    shape_options,
    show_types,
    stdin_option,
    topic_name,
)
from ros2_on_pip.words import (
    FAILED,
    OK,
    Run,
    Verbs,
    add,
    not_negative,
    positive,
    positive_seconds,
    rate,
    seconds,
)

HZ_WINDOW, BW_WINDOW, DELAY_WINDOW = 10_000, 100, 10_000
OF_EVERY_NODE = {
    "/parameter_events": ["rcl_interfaces/msg/ParameterEvent"],
    "/rosout": ["rcl_interfaces/msg/Log"],
}
"""The full tool lists them always, for its own node has them too."""


class TopicNotFound(CommandProblem):
    """No node has the topic."""

    def __init__(self, topic: str, there: list[str]) -> None:
        super().__init__(
            f"Unknown topic '{topic}'.{did_you_mean(topic, there)}\n"
            "To see what there is: ros2 topic list"
        )


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    hidden_topics(command)
    verbs = Verbs(command)
    _declare_looking(verbs)
    _declare_echo(verbs)
    _declare_measuring(verbs)
    _declare_pub(verbs)


def _declare_looking(verbs: Verbs) -> None:
    listing = verbs("list", "Output a list of available topics", list_topics)
    show_types(listing, "topic")
    count_only(listing, "topics")
    listing.add_argument(
        "-v", "--verbose", action="store_true", help="List full details about each topic"
    )
    also_hidden(listing, "topics", "-a")
    info = verbs("info", "Print information about a topic", show_info)
    topic_name(info)
    info.add_argument(
        "-v",
        "--verbose",
        action="store_true",
        help="Prints the nodes publishing to and subscribing to this topic, with their QoS",
    )
    kind = verbs("type", "Print a topic's type", show_type)
    topic_name(kind)
    find = verbs("find", "Output a list of available topics of a given type", find_topics)
    add(
        find,
        "topic_type",
        complete=complete_interfaces("msg"),
        help="Name of the ROS topic type to filter for (e.g. 'std_msgs/msg/String')",
    )
    count_only(find, "topics")
    also_hidden(find, "topics", "-a")
    for verb in (listing, info, kind, find):
        node_options(verb)


def _declare_echo(verbs: Verbs) -> None:
    from_home = "ros2_on_pip.echoing"
    echo = verbs("echo", "Output messages from a topic", _later(from_home, "echo"))
    topic_name(echo)
    add(
        echo,
        "message_type",
        nargs="?",
        complete=complete_type_of("topic", "msg"),
        help="Type of the ROS message (e.g. 'std_msgs/msg/String')",
    )
    echo.add_argument("--once", action="store_true", help="Print the first message and exit")
    echo.add_argument("--timeout", metavar="N", type=seconds, help="Exit after N seconds")
    echo.add_argument(
        "--field", action="append", help="Echo a selected field of a message, e.g. linear.x"
    )
    echo.add_argument(
        "--filter",
        metavar="EXPR",
        help="Print only messages for which this Python expression"
        " holds; m is the message, or the selected field: 'm.linear.x > 0'",
    )
    echo.add_argument(
        "-i",
        "--include-message-info",
        action="store_true",
        help="Print before each message when it was sent and received, and its number",
    )
    echo.add_argument("--raw", action="store_true", help="Print the bytes as they came")
    echo.add_argument(
        "--no-lost-messages", action="store_true", help="Don't report when a message is lost"
    )
    shape_options(echo)
    add_qos_options(echo, "subscribe")
    node_options(echo)
    also_hidden(echo, "topics", only_here=True)


def _declare_measuring(verbs: Verbs) -> None:
    home = "ros2_on_pip.measuring"
    hz = verbs("hz", "Print the average publishing rate to screen", _later(home, "hz"))
    bw = verbs("bw", "Display bandwidth used by topic", _later(home, "bw"))
    delay = verbs("delay", "Display delay of topic from timestamp in header", _later(home, "delay"))
    for verb, window in ((hz, HZ_WINDOW), (bw, BW_WINDOW), (delay, DELAY_WINDOW)):
        topic_name(verb)
        verb.add_argument(
            "-w",
            "--window",
            type=positive,
            default=window,
            metavar="N",
            help=f"window size, in # of messages (default: {window})",
        )
        add_qos_options(verb, "subscribe", only_here=True)
        node_options(verb, only_here=("no_daemon",))
        also_hidden(verb, "topics", only_here=True)
    hz.add_argument(
        "--filter",
        metavar="EXPR",
        help="Count only messages for which this Python expression holds; m is the message",
    )
    hz.add_argument(
        "--wall-time",
        action="store_true",
        help="Take the time of this computer, also with --use-sim-time",
    )


def _declare_pub(verbs: Verbs) -> None:
    pub = verbs("pub", "Publish a message to a topic", _later("ros2_on_pip.publishing", "publish"))
    topic_name(pub)
    add(
        pub,
        "message_type",
        complete=complete_type_of("topic", "msg"),
        help="Type of the ROS message (e.g. 'std_msgs/msg/String')",
    )
    values = pub.add_mutually_exclusive_group()
    add(
        values,
        "values",
        nargs="?",
        default="{}",
        complete=complete_values("message_type"),
        help="Values to fill the message with in YAML format (e.g. '{data: Hello World}')",
    )
    stdin_option(values, "the values")
    pub.add_argument(
        "-r",
        "--rate",
        metavar="N",
        type=rate,
        default=1.0,
        help="Publishing rate in Hz (default: 1)",
    )
    pub.add_argument(
        "-p",
        "--print",
        metavar="N",
        type=not_negative,
        default=1,
        help="Only print every N-th published message (default: 1)",
    )
    count = pub.add_mutually_exclusive_group()
    count.add_argument("-1", "--once", action="store_true", help="Publish one message and exit")
    count.add_argument(
        "-t", "--times", type=not_negative, default=0, help="Publish this number of times, exit"
    )
    pub.add_argument(
        "-w",
        "--wait-matching-subscriptions",
        metavar="N",
        type=not_negative,
        help="Wait for N subscriptions (default: 1 with --once and --times, else 0)",
    )
    pub.add_argument(
        "--max-wait-time-secs", metavar="S", type=seconds, help="... but not longer than S seconds"
    )
    pub.add_argument(
        "--keep-alive",
        metavar="S",
        type=positive_seconds,
        default=0.1,
        help="Stay for S seconds after the last message (default: 0.1)",
    )
    pub.add_argument("-n", "--node-name", help="Name of the created publishing node")
    add_qos_options(pub, "publish")
    node_options(pub, daemon=False)


def _later(home: str, function: str) -> Run:
    """The function of a module that is imported when it is called."""

    def call(options: argparse.Namespace) -> int:
        from importlib import import_module

        return int(getattr(import_module(home), function)(options))

    return call


def list_topics(options: argparse.Namespace) -> int:
    """`ros2 topic list`."""
    from ros2_on_pip.discovery import DirectNode

    with DirectNode.asked_by(options) as direct_node:
        found = direct_node.settle().topics(hidden=options.include_hidden_topics)
        topics = dict(sorted({**OF_EVERY_NODE, **found}.items()))
        if options.count:
            print(len(topics))
        elif options.verbose:
            _print_verbose(direct_node, topics)
        else:
            for name, types in topics.items():
                print(f"{name} [{', '.join(types)}]" if options.show_types else name)
    return OK


def _print_verbose(direct_node: object, topics: dict[str, list[str]]) -> None:
    for title, word, infos in (
        ("Published topics", "publisher", direct_node.publishers),  # type: ignore[attr-defined]
        ("Subscribed topics", "subscriber", direct_node.subscriptions),  # type: ignore[attr-defined]
    ):
        print(f"{title}:")
        for name, types in topics.items():
            if count := len(infos(name)):
                plural = "s" if count > 1 else ""
                print(f" * {name} [{', '.join(types)}] {count} {word}{plural}")
        print()


def show_info(options: argparse.Namespace) -> int:
    """`ros2 topic info TOPIC`."""
    from ros2_on_pip.discovery import DirectNode

    topic = full_topic(options.topic_name)
    with DirectNode.asked_by(options) as direct_node:
        types = direct_node.settle().topics().get(topic)
        if types is None:
            raise TopicNotFound(options.topic_name, list(direct_node.topics(hidden=False)))
        publishers, subscriptions = direct_node.publishers(topic), direct_node.subscriptions(topic)
        space = "\n" if options.verbose else ""
        print(f"Type: {types[0] if len(types) == 1 else types}{space}")
        for title, infos in (
            ("Publisher count", publishers),
            ("Subscription count", subscriptions),
        ):
            print(f"{title}: {len(infos)}{space}")
            for info in infos if options.verbose else ():
                print(f"{info}\n")
    return OK


def show_type(options: argparse.Namespace) -> int:
    """`ros2 topic type TOPIC`."""
    from ros2_on_pip.discovery import DirectNode

    with DirectNode.asked_by(options) as direct_node:
        topics = direct_node.settle().topics()
    types = topics.get(full_topic(options.topic_name))
    if not types:
        near = did_you_mean(options.topic_name, topics)
        print(f"No node has the topic '{options.topic_name}'.{near}", file=sys.stderr)
        return FAILED
    print("\n".join(types))
    return OK


def find_topics(options: argparse.Namespace) -> int:
    """`ros2 topic find TYPE`."""
    from ros2_on_pip.discovery import DirectNode
    from ros2_on_pip.interfaces import full_name

    wanted = full_type(options.topic_type, full_name(options.topic_type, "msg"))
    with DirectNode.asked_by(options) as direct_node:
        topics = direct_node.settle().topics(hidden=options.include_hidden_topics)
    names = [name for name, types in topics.items() if wanted in types]
    print("\n".join(names) if not options.count else len(names), end="\n" if names else "")
    return OK
