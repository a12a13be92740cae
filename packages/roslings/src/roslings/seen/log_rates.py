"""How often a node writes: a rate from the lines of its log, where nothing of ours listens.

Experiments use it to know when they have seen enough; checks use it to judge.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from roslings.course import NodeContract, RateContract
from roslings.evidence import LogLine

FEWEST_LINES = 5
"""With fewer nothing is known of their pace."""
NEARLY = 0.75
"""The part of the slowest right rate that is enough: lines come less evenly than messages."""


def is_often(hz: float | None, rate: RateContract) -> bool:
    """Whether it is nearly as often as the card asks."""
    return hz is not None and hz >= NEARLY * rate.low_hz


def hz_of(at_ns: Sequence[int]) -> float | None:
    """How often it was; None where it was too seldom to tell."""
    if len(at_ns) < FEWEST_LINES or at_ns[-1] == at_ns[0]:
        return None
    return (len(at_ns) - 1) * 1e9 / (at_ns[-1] - at_ns[0])


def written_hz(lines: Sequence[LogLine], node: NodeContract) -> float | None:
    """How often a node writes its line of the card; None where it wrote too few."""
    return hz_of(written_ns(lines, node))


def written_ns(lines: Sequence[LogLine], node: NodeContract) -> list[int]:
    """When a node wrote its line of the card, each time."""
    before, _, after = (node.log or "").partition("{text}")
    pattern = re.compile(re.escape(before) + ".*" + re.escape(after))
    return [line.arrival_ns for line in lines if pattern.search(line.text)]
