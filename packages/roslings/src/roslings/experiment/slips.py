"""A slip in a name costs one check: where nodes meet, it is put right by remapping."""

from __future__ import annotations

from ros2_on_pip.near_names import Near, nearest
from roslings.course import NodeContract
from roslings.evidence import ExperimentSeen
from roslings.seen.matching import nearest_endpoint


def mending(node: NodeContract, seen: ExperimentSeen) -> list[str]:
    """Remap rules that put a node's slips right, as seen when it ran alone.

    So a misspelt topic, judged where it belongs, does not cost a second check.
    """
    here = seen.graph
    name = nearest(node.node, here.nodes)
    pairs = [
        *((t, nearest_endpoint(here, "publisher", t.topic, t.type)) for t in node.publishes),
        *((t, nearest_endpoint(here, "subscription", t.topic, t.type)) for t in node.subscribes),
    ]
    topics = [f"{e.topic}:={t.topic}" for t, e in pairs if e and e.topic != t.topic]
    return [*(_renaming(name) if name and not name.exact else []), *topics]


def _renaming(name: Near) -> list[str]:
    wanted_space, _, wanted = name.wanted.rpartition("/")
    found = name.found.rpartition("/")[2]
    return [f"{found}:__node:={wanted}", f"{found}:__ns:={wanted_space or '/'}"]
