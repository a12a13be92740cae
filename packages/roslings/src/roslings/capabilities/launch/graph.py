"""The graph of one namespace, as it would be without it: what two namespaces have in common.

A leaf: experiments use it to know that all is there, checks to judge it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from roslings.evidence import GraphSeen
from roslings.seen.matching import own_endpoints


class Part(NamedTuple):
    """A node of a namespace, or what it does with a topic; names are without the namespace's."""

    node: str
    kind: str = ""
    """`publisher` or `subscription`; empty: it is the node itself."""
    topic: str = ""
    type: str = ""


def graph_in(graph: GraphSeen, namespace: str) -> frozenset[Part]:
    """The nodes of a namespace and what each publishes and hears.

    A topic outside of the namespace keeps its whole name, with the slash.
    """
    inside = f"{namespace}/"
    nodes = {Part(name.removeprefix(inside)) for name in graph.nodes if name.startswith(inside)}
    ends = {
        Part(end.node.removeprefix(inside), end.kind, end.topic.removeprefix(inside), end.type)
        for end in own_endpoints(graph)
        if end.node.startswith(inside)
    }
    return frozenset(nodes | ends)


def topics_outside(graph: GraphSeen, namespace: str) -> list[tuple[str, str]]:
    """Node and topic for each topic of a node in the namespace that does not lie in it."""
    inside = f"{namespace}/"
    return sorted(
        (end.node, end.topic)
        for end in own_endpoints(graph)
        if end.node.startswith(inside) and not end.topic.startswith(inside)
    )


def are_alike(graph: GraphSeen, namespaces: Sequence[str]) -> bool:
    """Whether the graph is the same in all of them."""
    return len({graph_in(graph, each) for each in namespaces}) <= 1
