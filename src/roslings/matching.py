"""What a student probably meant: the nearest name in the graph to the one in the contract.

A leaf: it imports only the evidence. Experiments use it to speak on the topic that is there;
checks use it to judge everything else on the near miss, so that one slip costs one check.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

from roslings.evidence import Endpoint, GraphSeen

How = Literal["exact", "namespace", "case", "spelling", "other"]
INFRASTRUCTURE = frozenset({"/rosout", "/parameter_events", "/clock"})
"""Topics that every node has, or that belong to the simulated clock."""

_ORDER: tuple[How, ...] = ("exact", "namespace", "case", "spelling", "other")
SIMILAR = 0.6


@dataclass(frozen=True)
class Near:
    """A name that is there, and how it differs from the one that was asked for."""

    wanted: str
    found: str
    how: How

    @property
    def slip(self) -> str:
        """Where two names differ by a letter or two: which, as /alve and /alive look alike."""
        pieces = difflib.SequenceMatcher(None, self.wanted, self.found).get_opcodes()
        others = [piece for piece in pieces if piece[0] != "equal"]
        if len(others) != 1:
            return ""
        ((_, begin, end, at, to),) = others
        missing, extra = self.wanted[begin:end], self.found[at:to]
        if missing and extra:
            return f"{extra!r} stands where {missing!r} is wanted"
        return f"{missing!r} is missing" if missing else f"{extra!r} is too much"

    @property
    def exact(self) -> bool:
        """It is the very name."""
        return self.how == "exact"


def nearest(wanted: str, names: Iterable[str]) -> Near | None:
    """The name nearest to `wanted`; None where there is no name at all."""
    candidates = [Near(wanted, name, _how(wanted, name)) for name in sorted(set(names))]
    return min(candidates, key=_distance, default=None)


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


def _how(wanted: str, name: str) -> How:
    if name == wanted:
        return "exact"
    if name.rpartition("/")[2] == wanted.rpartition("/")[2]:
        return "namespace"
    if name.lower() == wanted.lower():
        return "case"
    return "spelling" if _likeness(wanted, name) >= SIMILAR else "other"


def _distance(near: Near) -> tuple[int, float]:
    return _ORDER.index(near.how), -_likeness(near.wanted, near.found)


def _likeness(one: str, other: str) -> float:
    return difflib.SequenceMatcher(None, one, other).ratio()
