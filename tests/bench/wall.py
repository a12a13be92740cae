"""What each wall costs for one grading; prints, and asserts nothing.

    .venv/bin/python tests/bench/wall.py [ROUNDS]

Every wall has its turn in each round, so that all of them meet the same machine. As root, and where
every user can read this Python, there are three.
"""

from __future__ import annotations

import os
import statistics
import sys
import time
from collections import defaultdict

from check import cpu_s

from roslings.arena import choose_isolation, isolation_for_strangers
from roslings.course import lab
from roslings.experiment import MeasuringOptions, measure
from roslings.judge.loaded import judge_for
from roslings.workspace.inspect import inspect_package

CHOICE = "ROSLINGS_ISOLATION"
LAB = lab("topics")
WALLS = {"none": "domain", "namespaces": "", "user": "user"}
"""What the report calls it, and how it is asked for."""


def lack_of(wall: str) -> str:
    """Why it cannot be had here; empty where it can."""
    lack = isolation_for_strangers().lack if wall == "user" else choose_isolation().lack
    return lack.reason if lack and wall != "none" else ""


def seconds(for_others: bool, strangers: bool) -> tuple[float, float, float, float | None]:
    """Wall time, CPU time, time of the build, and the score of the solution."""
    began_s, began_cpu_s = time.monotonic(), cpu_s()
    files = inspect_package(LAB.solution, LAB.card)
    choices = MeasuringOptions(seed=1, strangers=strangers, for_others=for_others)
    with judge_for(LAB, strangers) as judge:
        evidence = measure(LAB.name, LAB.solution, files, choices, lambda step: None)
        verdict = judge(evidence, None)
    assert evidence.build
    took_s = time.monotonic() - began_s
    return took_s, cpu_s() - began_cpu_s, evidence.build.seconds, verdict.score


def main(rounds: int) -> None:
    """Print a row for each wall."""
    rows = defaultdict(list)
    for _ in range(rounds):
        for wall, choice in WALLS.items():
            os.environ.pop(CHOICE, None)
            os.environ.update({CHOICE: choice} if choice else {})
            if reason := lack_of(wall):
                print(f"{wall}: cannot be had here: {reason}", file=sys.stderr)
            else:
                rows[wall].append(seconds(for_others=True, strangers=wall != "none"))
        os.environ.pop(CHOICE, None)
        rows["a student's own check"].append(seconds(for_others=False, strangers=False))
    print("| wall | total s | of no wall | CPU s | build s | scores |\n" + "| --- " * 6 + "|")
    base_s = statistics.median(took_s for took_s, *_ in rows["none"])
    for wall, runs in rows.items():
        total_s, cpu, build_s = (
            statistics.median(column) for column in list(zip(*runs, strict=True))[:3]
        )
        scores = " ".join(f"{score:g}" if score is not None else "open" for *_, score in runs)
        print(
            f"| {wall} | {total_s:.1f} | {total_s / base_s:.2f} | {cpu:.1f} | {build_s:.1f} |"
            f" {scores} |"
        )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 5)
