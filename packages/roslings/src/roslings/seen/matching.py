"""What a student probably meant: the nearest name in the graph to the one in the contract.

Experiments use it to speak on the topic that is there. Checks use it to judge everything else on
the near miss, so that one slip costs one check.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from ros2_on_pip.near_names import nearest
from roslings.evidence import Endpoint, GraphSeen

INFRASTRUCTURE = frozenset({"/rosout", "/parameter_events", "/clock"})
"""Topics that every node has, or that belong to the simulated clock."""


def nearest_endpoint(
    graph: GraphSeen, kind: Literal["publisher", "subscription"], topic: str, type_: str
) -> Endpoint | None:
    """The endpoint of `kind` whose topic is nearest to `topic`, the right type first."""
    endpoints = [e for e in own_endpoints(graph) if e.kind == kind]
    same_type = [e for e in endpoints if e.type == type_]
    exact = [e for e in endpoints if e.topic == topic]
    pool: Sequence[Endpoint] = exact or same_type or endpoints
    near = nearest(topic, (e.topic for e in pool))
    return next((e for e in pool if near and e.topic == near.found), None)


def own_endpoints(graph: GraphSeen) -> list[Endpoint]:
    """The endpoints without those that ROS itself adds to every node."""
    return [e for e in graph.endpoints if e.topic not in INFRASTRUCTURE]
