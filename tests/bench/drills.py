"""Prints the time from save to verdict of each drill, beside a bare node; asserts nothing.

    .venv/bin/python tests/bench/drills.py [TIMES] [DAY]

All is loaded before, as in `watch`. Each time is also told as a ratio: over what a node of the same
run needs from its start until it is ready (median), so that machines can be compared.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import time
from collections.abc import Sequence

from roslings_learn.drills import Drill, all_drills
from roslings_learn.drills.course import of_day
from roslings_learn.drills.running import check, load

BARE = "import rclpy; rclpy.init(); rclpy.create_node('bare'); print('ready', flush=True)"


def bare_s() -> float:
    """From the start of Python until a node is there."""
    began_s = time.monotonic()
    subprocess.run([sys.executable, "-c", BARE], capture_output=True, check=True)
    return time.monotonic() - began_s


def times_s(one: Drill, times: int) -> list[float]:
    """From save to verdict, of the starter and of the solution in turn."""
    load(one)
    return [check(one, file).seconds for _ in range(times) for file in (one.starter, one.solution)]


def percentile(values: Sequence[float], part: float) -> float:
    """The value that so many are not above."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, round(part * (len(ordered) - 1)))]


def main() -> None:
    """Print a line for each drill, and one for all."""
    times = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    drills = of_day(all_drills(), sys.argv[2]) if len(sys.argv) > 2 else all_drills()
    every: list[float] = []
    floors: list[float] = []
    for one in drills:
        floors.append(bare_s())  # in turn: other work on the machine slows both
        found = times_s(one, times)
        every += found
        told = f"median {statistics.median(found):.2f} s, longest {max(found):.2f} s"
        print(f"{one.name:24} {told}; a node alone {floors[-1]:.2f} s")
    floor_s = statistics.median(floors)
    print(f"\na node alone: {floor_s:.2f} s from start to ready (median)")
    p50_s, p95_s = percentile(every, 0.5), percentile(every, 0.95)
    print(f"{len(every)} runs: p50 {p50_s:.2f} s ({p50_s / floor_s:.1f} nodes alone),", end=" ")
    print(f"p95 {p95_s:.2f} s ({p95_s / floor_s:.1f}), longest {max(every):.2f} s")


if __name__ == "__main__":
    main()
