"""Options that several verbs share, and what the Tab key offers for names in the graph."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Collection
from typing import Any

from ros2_on_pip.habits import OnlyHere, ShortOnlyHere
from ros2_on_pip.words import add, not_negative, seconds

DEFAULT_LENGTH = 128


DIRECT = ("spin_time", "use_sim_time")


def node_options(
    parser: argparse.ArgumentParser, daemon: bool = True, only_here: Collection[str] = ()
) -> None:
    """How to look: ours looks afresh each time, until it is done.

    `only_here` names those that the full tool does not take with this verb.
    """
    how = _switches(only_here)
    parser.add_argument(
        "--spin-time",
        type=seconds,
        default=0.0,
        metavar="S",
        action=OnlyHere if "spin_time" in only_here else "store",
        help="Look for S seconds at least (needed only where nodes of other computers start late)",
    )
    parser.add_argument(
        "-s", "--use-sim-time", **how("use_sim_time"), help="Take the time from the topic /clock"
    )
    if daemon:
        parser.add_argument(
            "--no-daemon", **how("no_daemon"), help="Use no daemon (here there is none anyway)"
        )


def _switches(only_here: Collection[str]) -> Callable[[str], dict[str, Any]]:
    """How argparse makes a switch: one that only we take says so."""

    def how(name: str) -> dict[str, Any]:
        if name not in only_here:
            return {"action": "store_true"}
        return {"action": OnlyHere, "nargs": 0, "default": False}

    return how


def hidden_topics(command: argparse.ArgumentParser) -> None:
    """`--include-hidden-topics` before the verb, as the full tool has it."""
    _hidden(command, "topics")


def hidden_services(command: argparse.ArgumentParser) -> None:
    """`--include-hidden-services` before the verb."""
    _hidden(command, "services")


def also_hidden(
    verb: argparse.ArgumentParser, what: str, *short: str, only_here: bool = False
) -> None:
    """The same option once more, after the verb; the full tool has no short form of it."""
    verb.add_argument(
        f"--include-hidden-{what}",
        *short,
        action=OnlyHere if only_here else ShortOnlyHere,
        nargs=0,
        default=argparse.SUPPRESS,
        help=f"Consider hidden {what} as well",
    )


def _hidden(command: argparse.ArgumentParser, what: str) -> None:
    command.add_argument(
        f"--include-hidden-{what}", action="store_true", help=f"Consider hidden {what} as well"
    )


def stdin_option(parser: argparse._ActionsContainer, what: str) -> None:
    """`--stdin`: the values come from another program, or from a file."""
    parser.add_argument("--stdin", action="store_true", help=f"Read {what} from standard input")


def values_in(options: argparse.Namespace, typed: str) -> str:
    """The YAML that was typed, or what comes on standard input."""
    return sys.stdin.read() if options.stdin else typed


def count_only(parser: argparse.ArgumentParser, what: str) -> None:
    """`-c`: the number only."""
    parser.add_argument(
        "-c",
        f"--count-{what}",
        dest="count",
        action="store_true",
        help=f"Only display the number of {what} discovered",
    )


def show_types(parser: argparse.ArgumentParser, what: str) -> None:
    """`-t`: the type beside each name."""
    parser.add_argument(
        "-t", "--show-types", action="store_true", help=f"Additionally show the {what} type"
    )


def topic_name(parser: argparse.ArgumentParser) -> None:
    """The name of a topic that is there."""
    add(
        parser,
        "topic_name",
        complete=complete_topics,
        help="Name of the ROS topic (e.g. '/chatter')",
    )


def in_node(parser: argparse.ArgumentParser, **how: Any) -> None:
    """The name of a running node, and whether hidden ones count."""
    add(parser, "node_name", complete=complete_nodes, help="Name of the ROS node", **how)
    parser.add_argument(
        "--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well"
    )


def shape_options(parser: argparse.ArgumentParser) -> None:
    """How much of a message is printed, and in which form."""
    parser.add_argument(
        "--csv", action="store_true", help="One line a message, its values parted by commas"
    )
    parser.add_argument(
        "-f", "--full-length", action="store_true", help="Do not cut long arrays and texts"
    )
    parser.add_argument(
        "-l",
        "--truncate-length",
        type=not_negative,
        default=DEFAULT_LENGTH,
        metavar="N",
        help=f"Cut arrays, bytes and texts after N (default: {DEFAULT_LENGTH})",
    )
    parser.add_argument("--no-arr", action="store_true", help="Don't print array fields")
    parser.add_argument("--no-str", action="store_true", help="Don't print string fields")
    parser.add_argument(
        "--flow-style", action="store_true", help="Print each list in one line (not with --csv)"
    )


def complete_topics(parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Every topic, for the Tab key."""
    from ros2_on_pip.discovery import DirectNode

    with DirectNode() as direct_node:
        return list(
            direct_node.settle().topics(getattr(parsed_args, "include_hidden_topics", False))
        )


def complete_nodes(parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Every node, for the Tab key."""
    from ros2_on_pip.discovery import DirectNode

    with DirectNode() as direct_node:
        return direct_node.settle().nodes(getattr(parsed_args, "include_hidden_nodes", False))


def complete_services(parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Every service, for the Tab key."""
    from ros2_on_pip.discovery import DirectNode

    with DirectNode() as direct_node:
        return list(
            direct_node.settle().services(getattr(parsed_args, "include_hidden_services", False))
        )


def complete_interfaces(kind: str) -> Any:
    """Every installed type of a kind, for the Tab key."""

    def complete(**_: Any) -> list[str]:
        from ros2_on_pip.interfaces import installed

        return [name for name in installed() if f"/{kind}/" in name]

    return complete


def complete_type_of(what: str, kind: str, look: Any = None) -> Any:
    """For the Tab key: the type of the topic, service or action just typed; else every one.

    `look` finds all of them and their types; by default the method of Eye that is called so.
    """

    def complete(parsed_args: argparse.Namespace, **how: Any) -> list[str]:
        from ros2_on_pip.discovery import DirectNode
        from ros2_on_pip.names import absolute

        with DirectNode() as direct_node:
            direct_node.settle()
            found = look(direct_node) if look else getattr(direct_node, f"{what}s")()
        types: list[str] = found.get(absolute(getattr(parsed_args, f"{what}_name")), [])
        return types or list(complete_interfaces(kind)(**how))

    return complete


def complete_values(type_of: str) -> Any:
    """For the Tab key: the fields of the type just typed, with their defaults."""

    def complete(parsed_args: argparse.Namespace, **_: Any) -> list[str]:
        from ros2_on_pip.interfaces import empty_message
        from ros2_on_pip.yaml_out import YamlOptions, as_yaml

        return [as_yaml(empty_message(getattr(parsed_args, type_of)), YamlOptions(longest=None))]

    return complete


def complete_packages(**_: Any) -> list[str]:
    """Every package, for the Tab key."""
    from ros2_on_pip.packages import packages

    return sorted(packages())
