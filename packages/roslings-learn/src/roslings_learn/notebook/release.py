"""The nodes of a context, and the callbacks of theirs that wait for what never comes.

A callback that calls `client.call()` blocks its executor for ever: the answer would come through
the same executor. The wait is on a lock, in C: only the future's end opens it.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from typing import Any

LAST = "_type_description_service"
"""What rclpy's Node makes last: without it, its __init__ failed, and nothing is to destroy."""

OF_ACTIONS = ("_pending_goal_requests", "_pending_cancel_requests", "_pending_result_requests")


def nodes_of(context: Any) -> list[Any]:
    """Every node in `context`, also those that a cell made itself and has forgotten.

    rclpy keeps no list of them, and a node that is not destroyed stays in the graph.
    """
    from rclpy.node import Node

    made = (each for each in gc.get_objects() if issubclass(type(each), Node))
    return [node for node in made if LAST in vars(node) and node.context is context]


def release_waits(node: Any) -> None:
    """Cancel every answer that `node` still waits for."""
    for future in list(_awaited(node)):
        future.cancel()


def _awaited(node: Any) -> Iterator[Any]:
    for client in list(node.clients):
        yield from list(getattr(client, "_pending_requests", {}).values())
    for waitable in list(node.waitables):
        for name in OF_ACTIONS:
            yield from list(getattr(waitable, name, {}).values())


def destroy(node: Any) -> None:
    """End a node with its action servers and clients.

    rclpy's own `destroy_node` leaves those alone, and they keep the node in the graph.
    """
    for waitable in list(node.waitables):
        if hasattr(waitable, "destroy"):
            waitable.destroy()
    node.destroy_node()
