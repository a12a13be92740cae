"""What one node has: subscriptions, publishers, services, actions; and which actions there are."""

from __future__ import annotations

from typing import Any

from ros2_on_pip.names import is_hidden

TypesByName = dict[str, list[str]]
Party = tuple[str, list[str]]
"""A node, and the types that it has for one name."""
SEND_GOAL, FEEDBACK = "/_action/send_goal", "/_action/feedback"
GOAL_SUFFIX, FEEDBACK_SUFFIX = "_SendGoal", "_FeedbackMessage"


def parts_of(direct_node: Any, node: str, hidden: bool = False) -> dict[str, TypesByName]:
    """The parts that `ros2 node info` shows, by their titles, in order."""
    services, clients = direct_node.of_node("service", node), direct_node.of_node("client", node)
    return {
        "Subscribers": _shown(direct_node.of_node("subscriber", node), hidden),
        "Publishers": _shown(direct_node.of_node("publisher", node), hidden),
        "Service Servers": _shown(services, hidden),
        "Service Clients": _shown(clients, hidden),
        "Action Servers": actions_in(services),
        "Action Clients": actions_in(clients),
    }


def _shown(entries: TypesByName, hidden: bool) -> TypesByName:
    return {name: types for name, types in entries.items() if hidden or not is_hidden(name)}


def actions_in(services: TypesByName) -> TypesByName:
    """An action is known by its goal service; its type is the service's without the suffix."""
    return {
        name.removesuffix(SEND_GOAL): [kind.removesuffix(GOAL_SUFFIX) for kind in types]
        for name, types in services.items()
        if name.endswith(SEND_GOAL)
    }


def actions(direct_node: Any) -> dict[str, list[str]]:
    """Every action in the graph, with its types: of servers and of clients."""
    found: dict[str, list[str]] = {}
    for name, parties in (*by_action(direct_node, "service"), *by_action(direct_node, "client")):
        types = found.setdefault(name, [])
        types += [kind for _, kinds in parties for kind in kinds if kind not in types]
    return dict(sorted(found.items()))


def by_action(direct_node: Any, role: str) -> list[tuple[str, list[Party]]]:
    """Each action with the nodes that serve it (role `service`) or use it (`client`)."""
    found: dict[str, list[Party]] = {}
    for node in direct_node.nodes(hidden=True):
        for name, types in actions_in(direct_node.of_node(role, node)).items():
            found.setdefault(name, []).append((node, types))
    return sorted(found.items())
