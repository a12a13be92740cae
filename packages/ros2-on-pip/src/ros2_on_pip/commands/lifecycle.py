"""`ros2 lifecycle`: nodes with states, and leading them from one state to the next."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from ros2_on_pip.commands.node import NodeNotFound
from ros2_on_pip.names import absolute, is_hidden
from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.shared_options import in_node, node_options
from ros2_on_pip.words import FAILED, OK, Verbs, add

if TYPE_CHECKING:
    from ros2_on_pip.discovery import DirectNode

GET_STATE, STATE_TYPE = "/get_state", "lifecycle_msgs/srv/GetState"


class NotALifecycleNode(CommandProblem):
    """The node runs, and has no states."""

    def __init__(self, node: str, there: list[str]) -> None:
        super().__init__(
            f"Node not found: '{node}' runs, but it is no lifecycle node, so it has no states."
            f" Lifecycle nodes here: {', '.join(there) or 'none'}"
        )


class UnknownTransition(CommandProblem):
    """The node cannot do this now."""

    def __init__(self, transitions: Iterable[Any]) -> None:
        lines = [f"- {one.transition.label} [{one.transition.id}]" for one in transitions]
        super().__init__("\n".join(["Unknown transition requested, available ones are:", *lines]))


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    verbs = Verbs(command)
    nodes = verbs("nodes", "Output a list of nodes with lifecycle", list_nodes)
    nodes.add_argument("-a", "--all", action="store_true", help="Display all nodes even hidden")
    nodes.add_argument(
        "-c", "--count-nodes", action="store_true", help="Only display the number of nodes"
    )
    get = verbs("get", "Get lifecycle state for one or more nodes", show_states)
    in_node(get, nargs="?")
    listing = verbs("list", "Output a list of available transitions", list_transitions)
    in_node(listing)
    listing.add_argument(
        "-a", "--all", action="store_true", help="Display all existing transitions"
    )
    setting = verbs("set", "Trigger lifecycle state transition", change)
    in_node(setting)
    add(setting, "transition", complete=complete_transitions, help="The lifecycle transition")
    for verb in (nodes, get, listing, setting):
        node_options(verb)


def complete_transitions(parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """What the node just typed can do now, for the Tab key."""
    with _seen(parsed_args) as (direct_node, node):
        return [one.transition.label for one in _transitions(direct_node, node)]


def lifecycle_nodes(direct_node: DirectNode, hidden: bool) -> list[str]:
    """Full names of the nodes that offer their state."""
    services = direct_node.services()
    nodes = [
        name.removesuffix(GET_STATE)
        for name, types in services.items()
        if name.endswith(GET_STATE) and STATE_TYPE in types
    ]
    return [node for node in nodes if hidden or not is_hidden(node)]


@contextmanager
def _seen(options: argparse.Namespace) -> Iterator[tuple[DirectNode, str]]:
    """Our eye and the full name of the lifecycle node in `options`.

    Raises NodeNotFound, NotALifecycleNode.
    """
    from ros2_on_pip.discovery import DirectNode

    node = absolute(options.node_name)
    with DirectNode.asked_by(options, speaks=True) as direct_node:
        running = direct_node.settle().nodes(hidden=options.include_hidden_nodes)
        if node not in running:
            raise NodeNotFound(options.node_name, running, "Node not found:")
        there = lifecycle_nodes(direct_node, options.include_hidden_nodes)
        if node not in there:
            raise NotALifecycleNode(node, there)
        yield direct_node, node


def list_nodes(options: argparse.Namespace) -> int:
    """`ros2 lifecycle nodes`."""
    from ros2_on_pip.discovery import DirectNode

    with DirectNode.asked_by(options) as direct_node:
        nodes = lifecycle_nodes(direct_node.settle(), options.all)
    if options.count_nodes:
        print(len(nodes))
    elif nodes:
        print("\n".join(nodes))
    return OK


def show_states(options: argparse.Namespace) -> int:
    """`ros2 lifecycle get [NODE]`."""
    if options.node_name:
        with _seen(options) as (direct_node, node):
            print(_state(direct_node, node))
        return OK
    from ros2_on_pip.discovery import DirectNode

    with DirectNode.asked_by(options, speaks=True) as direct_node:
        for node in lifecycle_nodes(direct_node.settle(), options.include_hidden_nodes):
            print(f"{node}: {_state(direct_node, node)}")
    return OK


def _state(direct_node: DirectNode, node: str) -> str:
    from lifecycle_msgs.srv import GetState

    from ros2_on_pip.calling import ask

    state = ask(direct_node, GetState, f"{node}{GET_STATE}", GetState.Request()).current_state
    return f"{state.label} [{state.id}]"


def _transitions(direct_node: DirectNode, node: str, every: bool = False) -> list[Any]:
    from lifecycle_msgs.srv import GetAvailableTransitions

    from ros2_on_pip.calling import ask

    service = "get_transition_graph" if every else "get_available_transitions"
    request = GetAvailableTransitions.Request()
    answer = ask(direct_node, GetAvailableTransitions, f"{node}/{service}", request)
    return list(answer.available_transitions)


def list_transitions(options: argparse.Namespace) -> int:
    """`ros2 lifecycle list NODE`."""
    with _seen(options) as (direct_node, node):
        for one in _transitions(direct_node, node, options.all):
            print(f"- {one.transition.label} [{one.transition.id}]")
            print(f"\tStart: {one.start_state.label}\n\tGoal: {one.goal_state.label}")
    return OK


def change(options: argparse.Namespace) -> int:
    """`ros2 lifecycle set NODE TRANSITION`."""
    from lifecycle_msgs.srv import ChangeState

    from ros2_on_pip.calling import ask

    with _seen(options) as (direct_node, node):
        chosen = _chosen(_transitions(direct_node, node), options.transition)
        request = ChangeState.Request(transition=chosen)
        done = ask(direct_node, ChangeState, f"{node}/change_state", request, again=False).success
    print(
        "Transitioning successful" if done else "Transitioning failed",
        file=sys.stdout if done else sys.stderr,
    )
    return OK if done else FAILED


def _chosen(transitions: list[Any], word: str) -> Any:
    """The transition of that label, or else of that number. Raises UnknownTransition."""
    every = [one.transition for one in transitions]
    for one in (*(t for t in every if t.label == word), *(t for t in every if str(t.id) == word)):
        return one
    raise UnknownTransition(transitions)
