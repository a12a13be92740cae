"""`ros2 action`: which actions there are, who offers them, and sending a goal."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from ros2_on_pip.habits import full_topic
from ros2_on_pip.names import absolute
from ros2_on_pip.node_parts import actions, by_action
from ros2_on_pip.shared_options import (
    complete_type_of,
    complete_values,
    count_only,
    node_options,
    show_types,
    stdin_option,
)
from ros2_on_pip.words import FAILED, OK, Verbs, add

if TYPE_CHECKING:
    from ros2_on_pip.discovery import DirectNode


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    verbs = Verbs(command)
    listing = verbs("list", "Output a list of action names", list_actions)
    show_types(listing, "action")
    count_only(listing, "actions")
    info = verbs("info", "Print information about an action", show_info)
    _action_name(info)
    show_types(info, "action")
    info.add_argument(
        "-c",
        "--count",
        action="store_true",
        help="Only display the number of action clients and action servers",
    )
    kind = verbs("type", "Print an action's type", show_type)
    _action_name(kind)
    for verb in (listing, info, kind):
        node_options(verb)
    send = verbs("send_goal", "Send an action goal", send_goal)
    _action_name(send)
    add(
        send,
        "action_type",
        complete=complete_type_of("action", "action", actions),
        help="Type of the ROS action (e.g. 'test_msgs/action/Fibonacci')",
    )
    goal = send.add_mutually_exclusive_group()
    add(
        goal,
        "goal",
        nargs="?",
        default="{}",
        complete=complete_values("action_type"),
        help="Goal request values in YAML format (e.g. '{order: 10}')",
    )
    stdin_option(goal, "the goal")
    send.add_argument(
        "-f", "--feedback", action="store_true", help="Echo feedback messages for the goal"
    )


def _action_name(parser: argparse.ArgumentParser) -> None:
    add(
        parser,
        "action_name",
        complete=complete_actions,
        help="Name of the ROS action (e.g. '/fibonacci')",
    )


def complete_actions(**_: Any) -> list[str]:
    """Every action, for the Tab key."""
    from ros2_on_pip.discovery import DirectNode

    with DirectNode() as direct_node:
        return list(actions(direct_node.settle()))


def list_actions(options: argparse.Namespace) -> int:
    """`ros2 action list`."""
    from ros2_on_pip.discovery import DirectNode

    with DirectNode.asked_by(options) as direct_node:
        found = actions(direct_node.settle())
    if options.count:
        print(len(found))
        return OK
    for name, types in found.items():
        print(f"{name} [{', '.join(types)}]" if options.show_types else name)
    return OK


def show_type(options: argparse.Namespace) -> int:
    """`ros2 action type ACTION`."""
    from ros2_on_pip.discovery import DirectNode

    name = full_topic(options.action_name)
    with DirectNode.asked_by(options) as direct_node:
        types = actions(direct_node.settle()).get(name, [])
        _say_near(direct_node, name)
    print("".join(f"{kind}\n" for kind in types), end="")
    return OK if types else FAILED


def show_info(options: argparse.Namespace) -> int:
    """`ros2 action info ACTION`."""
    from ros2_on_pip.discovery import DirectNode

    name = absolute(options.action_name)
    with DirectNode.asked_by(options) as direct_node:
        direct_node.settle()
        _say_near(direct_node, name)
        clients = dict(by_action(direct_node, "client")).get(name, [])
        servers = dict(by_action(direct_node, "service")).get(name, [])
    print(f"Action: {options.action_name}")
    for title, parties in (("Action clients", clients), ("Action servers", servers)):
        print(f"{title}: {len(parties)}")
        for node, types in parties if not options.count else ():
            print(f"    {node} [{', '.join(types)}]" if options.show_types else f"    {node}")
    return OK


def _say_near(direct_node: DirectNode, name: str) -> None:
    import sys

    from ros2_on_pip.problem import did_you_mean

    there = actions(direct_node)
    if name not in there:
        print(f"No node has the action '{name}'.{did_you_mean(name, there)}", file=sys.stderr)


def send_goal(options: argparse.Namespace) -> int:
    """`ros2 action send_goal ACTION TYPE GOAL`."""
    from ros2_on_pip.goal import send

    return send(options)
