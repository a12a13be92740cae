"""Which rooms are fair: three designs have all points in them, along the left and the right wall.

Prints the numbers for `graders/wander/fair.py`, as it finds them:

    .venv/bin/python tests/lab_folders/wander/fair_rooms.py 1000 1300
    .venv/bin/python tests/lab_folders/wander/fair_rooms.py --busy 2000 2600

With `--busy` those along one wall, with its side: there something that moves comes into the way of
each design, and it has all points.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parents[2]
sys.path[:0] = [str(REPOSITORY), str(HERE), str(REPOSITORY / "labs/wander/solution/wander")]

from designs import Waiting, bang_bang, vector_field  # noqa: E402
from driving import Design, driven, failed, view_of  # noqa: E402
from sensor_msgs.msg import LaserScan  # noqa: E402

from roslings.capabilities.rooms.record import Side  # noqa: E402
from roslings.capabilities.rooms.seeds import SIDES, RoomToDrive  # noqa: E402
from roslings.capabilities.rooms.seen import encounters  # noqa: E402


class Solution:
    """The rule of the lab's own node, without its node."""

    def __init__(self, side: Side) -> None:
        from wander import wander

        self._by_degrees = wander.by_degrees
        self._node: Any = object.__new__(wander.Wander)
        self._node.stands_since, self._node.goes_at, self._node.ahead = None, 0.0, math.inf
        self._sign = 1 if side == "left" else -1

    def __call__(self, scan: LaserScan) -> tuple[float, float]:
        """Forward, and a turn that is positive to the left."""
        now_s = scan.header.stamp.sec + scan.header.stamp.nanosec / 1e9
        forward, turn = self._node.decide(self._by_degrees(scan, self._sign), now_s)
        return forward, self._sign * turn


DESIGNS: dict[str, Callable[[Side], Design]] = {
    "bang-bang": lambda side: Waiting(bang_bang, side),
    "vector field": lambda side: Waiting(vector_field, side),
    "solution": Solution,
}


def unfair_to(seed: int) -> Iterator[str]:
    """Each design and side that loses points in this room, and by which checks."""
    for name, design in DESIGNS.items():
        for side in SIDES:
            drive = driven(RoomToDrive(seed, False, side), design(side))
            if lost := failed(view_of([drive])):
                yield f"{name}, {side}: {', '.join(lost)}"


def is_busy(seed: int, side: Side) -> bool:
    """Each design meets something that moves along this wall, and loses no point."""
    drives = (driven(RoomToDrive(seed, False, side), make(side)) for make in DESIGNS.values())
    return all(encounters(drive) and not failed(view_of([drive])) for drive in drives)


def main() -> None:
    """Look at each number between two."""
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--busy", action="store_true")
    words.add_argument("first", type=int)
    words.add_argument("last", type=int)
    asked = words.parse_args()
    for seed in range(asked.first, asked.last + 1):
        if asked.busy:
            for side in filter(partial(is_busy, seed), SIDES):
                print(seed, side, flush=True)
        elif told := next(unfair_to(seed), ""):
            print(f"{seed}: {told}", file=sys.stderr, flush=True)
        else:
            print(seed, flush=True)


if __name__ == "__main__":
    main()
