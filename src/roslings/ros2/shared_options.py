"""Options that several verbs share, and what the Tab key offers for names in the graph."""

from __future__ import annotations

import argparse
from typing import Any

from roslings.ros2.words import add, seconds


def node_options(parser: argparse.ArgumentParser) -> None:
    """Options of the real tool on how it looks; ours always looks afresh, until it is done."""
    quiet = argparse.SUPPRESS
    parser.add_argument("--no-daemon", action="store_true", help=quiet)
    parser.add_argument("--spin-time", type=seconds, help=quiet)
    parser.add_argument("-s", "--use-sim-time", action="store_true", help=quiet)


def hidden_topics(parser: argparse.ArgumentParser) -> None:
    """`--include-hidden-topics`."""
    parser.add_argument(
        "--include-hidden-topics", "-a", action="store_true", help="Consider hidden topics as well"
    )


def count_only(parser: argparse.ArgumentParser, what: str) -> None:
    """`-c`: the number only."""
    parser.add_argument(
        "-c", f"--count-{what}", dest="count", action="store_true",
        help=f"Only display the number of {what} discovered",
    )  # fmt: skip


def show_types(parser: argparse.ArgumentParser, what: str) -> None:
    """`-t`: the type beside each name."""
    parser.add_argument(
        "-t", "--show-types", action="store_true", help=f"Additionally show the {what} type"
    )


def topic_name(parser: argparse.ArgumentParser) -> None:
    """The name of a topic that is there."""
    add(
        parser, "topic_name", complete=complete_topics,
        help="Name of the ROS topic (e.g. '/chatter')",
    )  # fmt: skip


def in_node(parser: argparse.ArgumentParser, **how: Any) -> None:
    """The name of a running node, and whether hidden ones count."""
    add(parser, "node_name", complete=complete_nodes, help="Name of the ROS node", **how)
    parser.add_argument(
        "--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well"
    )


def complete_topics(**_: Any) -> list[str]:
    """Every topic, for the Tab key."""
    from roslings.ros2.eye import Eye

    with Eye() as eye:
        return list(eye.settle().topics(hidden=False))


def complete_nodes(**_: Any) -> list[str]:
    """Every node, for the Tab key."""
    from roslings.ros2.eye import Eye

    with Eye() as eye:
        return eye.settle().nodes()


def complete_services(**_: Any) -> list[str]:
    """Every service, for the Tab key."""
    from roslings.ros2.eye import Eye

    with Eye() as eye:
        return list(eye.settle().services(hidden=False))


def complete_interfaces(kind: str) -> Any:
    """Every installed type of a kind, for the Tab key."""

    def complete(**_: Any) -> list[str]:
        from roslings.ros2.interfaces import installed

        return [name for name in installed() if f"/{kind}/" in name]

    return complete


def complete_packages(**_: Any) -> list[str]:
    """Every package, for the Tab key."""
    from roslings.ros2.packages import packages

    return sorted(packages())
