"""The measuring process: build the package, run the grader's experiments, write the evidence.

    python -m roslings.experiment.measuring ASSIGNMENT

It writes one line of text a step to standard output, for the command to show.
"""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path
from types import FrameType

from roslings.arena import Installed, kernel, opened, ros_environment
from roslings.course import lab
from roslings.evidence import BuildSeen, Evidence, ExperimentSeen
from roslings.experiment.assignment import Assignment
from roslings.experiment.declare import Experiment, experiments_of, load_grader
from roslings.experiment.machine import look_at_machine
from roslings.experiment.scene import Scene
from roslings.probe import Probe
from roslings.workspace.build import BuildRoom, build


class Stopped(BaseException):
    """The command wants this process to end: leave every block, and end what it started."""


def main(path: Path) -> None:
    """Measure what the file at `path` asks for."""
    kernel.die_with_parent()
    signal.signal(signal.SIGTERM, _stop)
    assignment = Assignment.model_validate_json(path.read_text("utf-8"))
    os.environ.update(ros_environment(assignment.wall))
    os.environ["ROS_LOG_DIR"] = str(assignment.home / "log")  # not in the student's ~/.ros
    evidence = measure_here(assignment)
    assignment.evidence.write_text(evidence.model_dump_json(by_alias=True), "utf-8")


def _stop(number: int, frame: FrameType | None) -> None:
    raise Stopped


def measure_here(assignment: Assignment) -> Evidence:
    """Build, and run the experiments in their order."""
    task = lab(assignment.lab)
    say(f"Building {task.card.package} with colcon")
    seen, installed = _build(assignment, task.card.package)
    evidence = Evidence(
        lab=task.name,
        seed=assignment.seed,
        machine=look_at_machine(assignment.wall),
        package=assignment.package,
        build=seen,
    )
    if installed:
        for number, each in enumerate(experiments_of(load_grader(task.grader))):
            say(f"Watching: {each.about}")
            earlier = [evidence.experiments[name] for name in each.needs]
            evidence.experiments[each.name] = run_experiment(
                each, installed, assignment, task.card.ends_within_s, number, earlier
            )
    return evidence


def _build(assignment: Assignment, package: str) -> tuple[BuildSeen, Installed | None]:
    room = BuildRoom(assignment.folder, package)
    return build(room, assignment.home, namespaces=assignment.wall == "namespace")


def run_experiment(
    each: Experiment,
    installed: Installed,
    assignment: Assignment,
    ends_within_s: float,
    number: int,
    earlier: list[ExperimentSeen],
) -> ExperimentSeen:
    """Run one experiment in a fresh arena."""
    seen = ExperimentSeen(name=each.name, clock="wall")
    with (
        opened(installed, assignment.wall, assignment.home) as arena,
        Probe(arena.domain_id, seen) as probe,
    ):
        scene = Scene(arena, probe, assignment.seed + number, ends_within_s)
        each.function(scene, *earlier)
    return seen


def say(step: str) -> None:
    """Tell the command what happens now."""
    print(step, flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
