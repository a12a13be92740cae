"""Prints figures of actions: feedback rate, cancel latency, time to verdict; asserts nothing.

    .venv/bin/python tests/bench/actions.py [CANCELS]

CANCELS is how many goals are cancelled on the way (20 without it).
"""

from __future__ import annotations

import os
import shutil
import statistics
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import roslings.folders.lab_folders  # noqa: F401  # `graders` can be imported from here on
from graders.actions.record import stopped_after_s
from ros2_on_pip.rates import measure_rate
from roslings.capabilities.actions.record import ActionsSeen, cancelled_after_s
from roslings.capabilities.robot.record import RobotSeen
from roslings.course import Lab, lab, root
from roslings.evidence import ExperimentSeen
from roslings.experiment import MeasuringOptions, measure
from roslings.grading.checking import ready
from roslings.workspace.inspect import inspect_package

GRADER = Path(__file__).with_name("grade_cancels.py")


def timed(course: Path, cancels: int) -> ExperimentSeen:
    """The solution of the lab, measured by the grader beside this file."""
    (course / "graders").mkdir()
    shutil.copytree(root() / "labs" / "actions", course / "labs" / "actions")
    shutil.copyfile(GRADER, course / "graders" / "grade_actions.py")
    os.environ |= {"ROSLINGS_COURSE": str(course), "ROSLINGS_BENCH_CANCELS": str(cancels)}
    each = lab("actions")
    files = inspect_package(each.solution, each.card)
    evidence = measure(each.name, each.solution, files, MeasuringOptions(seed=1), lambda step: None)
    del os.environ["ROSLINGS_COURSE"]
    return evidence.experiments["timing"]


def show(name: str, times_s: Sequence[float]) -> None:
    """One line: p50, p95 and the worst."""
    ordered = sorted(times_s)
    p95_s = ordered[min(len(ordered) - 1, round(0.95 * len(ordered)))]
    print(
        f"{name:34} p50 {1000 * statistics.median(ordered):4.0f} ms, p95 {1000 * p95_s:4.0f} ms,"
        f" worst {1000 * ordered[-1]:4.0f} ms ({len(ordered)})"
    )


def show_rates(seen: ExperimentSeen) -> None:
    """The feedback of the goal that was driven to its end."""
    last = seen.part(ActionsSeen).goals[-1]
    messages = seen.topics[last.feedback_topic].messages
    own = [m for m in messages if m.content["goal_id"]["uuid"] == last.id]
    if rate := measure_rate(own):
        periods = f"longest period {max(rate.periods_s):.3f} s"
        print(f"{'feedback':34} {rate.hz:.2f} Hz (±{rate.uncertainty_hz:.2f}), {periods}")


def show_verdict(each: Lab) -> None:
    """A whole grading."""
    began_ns = time.monotonic_ns()
    with ready(each, MeasuringOptions(seed=1)) as begun:
        verdict = begun.grade(each.solution, began_ns, quiet=True).verdict
    print(f"{'time to verdict':34} {verdict.seconds.total:.1f} s, {verdict.score:g} points")


def main(cancels: int) -> None:
    """Print all of it."""
    with tempfile.TemporaryDirectory() as folder:
        seen = timed(Path(folder), cancels)
    goals = [goal for goal in seen.part(ActionsSeen).goals if goal.cancel_sent_ns]
    show_rates(seen)
    show("cancel: goal ended", [t for g in goals if (t := cancelled_after_s(g)) is not None])
    drive = seen.part(RobotSeen).drive
    assert drive is not None
    stops = [stopped_after_s(goal, drive) for goal in goals]
    show("cancel: robot told to stand still", [t for t in stops if t is not None])
    print(f"{'this computer stood still for':34} {1000 * seen.stall_s:.0f} ms at most")
    show_verdict(lab("actions"))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 20)
