"""A drive is believed where one at half the speed of wall time ends alike.

What a node reads of the wall clock, or of its own slowness, then comes out: half the speed changes
that, and nothing else.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from roslings.lockstep.record import LockstepDrive
from roslings.lockstep.stepping import DriveBudget

TIMES_SLOWER = 2.0
SAME_PLACE_M = 0.05
SAME_WAY_M = 0.1

Alike = Callable[[LockstepDrive, LockstepDrive], bool]


@dataclass(frozen=True)
class Believed:
    """One or two drives, and whether the first tells how the nodes drive."""

    first: LockstepDrive
    second: LockstepDrive | None
    """None where the first was enough to see that real time must judge."""
    why_not: str = ""
    """Empty where it is believed."""

    @property
    def is_believed(self) -> bool:
        """Else the same room is driven in real time, and the verdict says so."""
        return not self.why_not


def drive_twice(
    run: Callable[[DriveBudget], LockstepDrive],
    budget: DriveBudget | None = None,
    alike: Alike | None = None,
) -> Believed:
    """`run` starts the nodes afresh and drives the same room; `alike` compares two outcomes."""
    budget = budget or DriveBudget()
    first = run(budget)
    if first.end != "done":
        return Believed(first, None, first.why)
    if first.sleepers:
        return Believed(first, None, first.sleepers[0].words)
    second = run(budget.slower(TIMES_SLOWER, first.tick_s))
    if (alike or ends_alike)(first, second):
        return Believed(first, second)
    return Believed(
        first,
        second,
        "At half the speed the same room ends otherwise: your nodes use the wall clock, "
        "or compute too long for each message. They are judged in real time.",
    )


def ends_alike(first: LockstepDrive, second: LockstepDrive) -> bool:
    """As many bumps, as long a way, the same place at the end."""
    if first.end != second.end or len(first.bumps) != len(second.bumps):
        return False
    if not (first.ticks and second.ticks):
        return len(first.ticks) == len(second.ticks)
    one, two = first.ticks[-1], second.ticks[-1]
    apart_m = math.dist((one.x_m, one.y_m), (two.x_m, two.y_m))
    return apart_m <= SAME_PLACE_M and abs(first.way_m - second.way_m) <= SAME_WAY_M
