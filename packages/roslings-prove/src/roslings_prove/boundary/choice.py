"""Which faults are tried: the same each time, spread over places and operators, half of them aimed.

The order is that of hashes, as in `generated/choice.py`: a new field moves few of the others.
"""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterable

from roslings.course import Lab
from roslings_prove.boundary.faults import BoundaryFault, faults

SEED = 20261128
WANTED = 60
"""So many of a lab; all, where there are fewer."""


def tried(lab: Lab) -> list[BoundaryFault]:
    """The faults of a lab that are graded. Raises UnknownInterface."""
    return chosen(faults(lab), WANTED)


def chosen(found: Iterable[BoundaryFault], wanted: int) -> list[BoundaryFault]:
    """So many: each time one of the place and the operator that were met least so far."""
    left = sorted(found, key=_drawn)
    met: Counter[object] = Counter()
    result: list[BoundaryFault] = []
    while left and len(result) < wanted:
        aimed = sum(fault.is_aimed for fault in result)
        wants_aimed = 2 * aimed <= len(result)
        next_one = min(left, key=lambda fault: _turn(fault, met, wants_aimed))
        left.remove(next_one)
        met.update((next_one.place, next_one.operator))
        result.append(next_one)
    return result


def _turn(fault: BoundaryFault, met: Counter[object], wants_aimed: bool) -> tuple[int, bool, int]:
    """What is new comes first: a place, an operator; then the kind that is wanted."""
    counts = met[fault.place], met[fault.operator]
    return -counts.count(0), fault.is_aimed != wants_aimed, sum(counts)


def _drawn(fault: BoundaryFault) -> str:
    return hashlib.sha256(f"{SEED} {fault.name}".encode()).hexdigest()
