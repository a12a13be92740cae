"""`ros2 node`: which nodes run, and what each has."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable

from ros2_on_pip.habits import full_node
from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.shared_options import complete_nodes, count_only, node_options
from ros2_on_pip.words import OK, Verbs, add

SAME_NAME = (
    "WARNING: Be aware that there are nodes in the graph that share an exact name,"
    " which can have unintended side effects."
)


class NodeNotFound(CommandProblem):
    """No running node has that name."""

    def __init__(
        self, node: str, running: Iterable[str], words: str = "Unable to find node"
    ) -> None:
        names = sorted(running)
        near = did_you_mean(node, names)
        there = " No node runs. Start one first." if not names else ""
        super().__init__(f"{words} '{node}'.{near or there}\nTo see what runs: ros2 node list")


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    verbs = Verbs(command)
    listing = verbs("list", "Output a list of available nodes", list_nodes)
    listing.add_argument("-a", "--all", action="store_true", help="Display hidden nodes as well")
    count_only(listing, "nodes")
    node_options(listing)
    info = verbs("info", "Output information about a node", show_info)
    add(info, "node_name", complete=complete_nodes, help="Node name to request information")
    info.add_argument(
        "--include-hidden",
        action="store_true",
        help="Display hidden topics, services, and actions as well",
    )
    node_options(info)


def list_nodes(options: argparse.Namespace) -> int:
    """`ros2 node list`."""
    from ros2_on_pip.discovery import DirectNode

    with DirectNode.asked_by(options) as direct_node:
        names = direct_node.settle(only_nodes=True).nodes(hidden=options.all)
    if options.count:
        print(len(names))
        return OK
    if len(set(names)) < len(names):
        print(SAME_NAME, file=sys.stderr)
    print("".join(f"{name}\n" for name in names), end="")
    return OK


def show_info(options: argparse.Namespace) -> int:
    """`ros2 node info NODE`."""
    from ros2_on_pip.discovery import DirectNode

    with DirectNode.asked_by(options) as direct_node:
        name = full_node(options.node_name)
        running = direct_node.settle().nodes(hidden=options.include_hidden)
        if name not in running:
            raise NodeNotFound(options.node_name, running)
        if running.count(name) > 1:
            print(
                f"There are {running.count(name)} nodes in the graph with the exact name"
                f' "{name}". You are seeing information about only one of them.',
                file=sys.stderr,
            )
        print("\n".join([name, *info_lines(direct_node, name, options.include_hidden)]))
    return OK


def info_lines(direct_node: object, name: str, hidden: bool) -> list[str]:
    """The six parts of `node info`, each with its title."""
    from ros2_on_pip.node_parts import parts_of

    return [
        line
        for title, entries in parts_of(direct_node, name, hidden).items()
        for line in (f"  {title}:", *_entries(entries))
    ]


def _entries(entries: dict[str, list[str]]) -> list[str]:
    lines = [f"    {name}: {', '.join(types)}" for name, types in entries.items()]
    return lines or [""]
