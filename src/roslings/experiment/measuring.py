"""The measuring process: build the package, run the grader's experiments, write the evidence.

    python -m roslings.experiment.measuring ASSIGNMENT

It writes one line of text a step to standard output, for the command to show.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Literal

from roslings.arena import Installed, kernel, opened, ros_environment
from roslings.course import lab
from roslings.evidence import BuildSeen, Evidence, ExperimentSeen
from roslings.experiment.assignment import Assignment
from roslings.experiment.declare import Experiment, experiments_of, load_grader
from roslings.experiment.machine import look_at_machine
from roslings.experiment.scene import Scene
from roslings.experiment.simulated import clock_publishers
from roslings.probe import Probe
from roslings.probe.bag import MOST_BYTES, fresh_folder, write_bag
from roslings.workspace.build import BuildRoom, build

MOST_RUNS = 3
"""A busy computer is given two more chances; then the verdict is inconclusive."""


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
        stage = Stage(installed, assignment, task.card.ends_within_s)
        for number, each in enumerate(experiments_of(load_grader(task.grader))):
            say(f"Watching: {each.about}")
            earlier = [evidence.experiments[name] for name in each.needs]
            *attempts, last = stage.runs_of(each, number, earlier)
            evidence.experiments[each.name] = last
            evidence.attempts.extend(attempts)
    evidence.advice.extend(advice_on_clocks(evidence))
    return evidence


def advice_on_clocks(evidence: Evidence) -> list[str]:
    """What a student learns from a run in simulated time that was not believed."""
    found = []
    for seen in evidence.attempts:
        spoke = any(topic.messages for topic in evidence.experiments[seen.name].topics.values())
        if seen.ignores_clock and spoke:
            names = ", ".join(sorted(set(seen.graph.nodes)))
            found.append(
                f"{names} does not follow simulated time (/clock), so it was watched in real"
                " time. A timer of create_timer() follows it; time.sleep() and threads do not."
            )
        found += [
            f"{node} publishes on /clock. That is for a simulator: it sets the time of all nodes."
            for node in clock_publishers(seen)
        ]
    return found


def _build(assignment: Assignment, package: str) -> tuple[BuildSeen, Installed | None]:
    room = BuildRoom(assignment.folder, package)
    return build(room, assignment.home, namespaces=assignment.wall == "namespace")


@dataclass(frozen=True)
class Stage:
    """What every experiment of one package works with."""

    installed: Installed
    assignment: Assignment
    ends_within_s: float

    def runs_of(
        self, each: Experiment, number: int, earlier: Sequence[ExperimentSeen]
    ) -> Iterator[ExperimentSeen]:
        """Run an experiment until one run is to be believed; that one comes last."""
        choice = self.assignment.clock if each.clock == "auto" else "wall"
        if choice != "wall":
            yield (seen := self.run(each, "sim", number, earlier))
            if choice == "sim" or seen.not_believed is None:
                return
        for _ in range(MOST_RUNS):
            yield (seen := self.run(each, "wall", number, earlier))
            if seen.machine_fault is None:
                return
            say("This computer was too busy to tell; once more")

    def run(
        self,
        each: Experiment,
        clock: Literal["sim", "wall"],
        number: int,
        earlier: Sequence[ExperimentSeen],
    ) -> ExperimentSeen:
        """Run an experiment once, in a fresh arena."""
        seen = ExperimentSeen(name=each.name, clock=clock)
        large_bytes = MOST_BYTES if self.assignment.keeps_bags else 0
        wall = self.assignment.wall
        with (
            opened(self.installed, wall, self.assignment.home) as arena,
            Probe(arena.domain_id, seen, large_bytes=large_bytes) as probe,
        ):
            scene = Scene(arena, probe, self.assignment.seed + number, self.ends_within_s)
            each.function(scene, *earlier)
        if self.assignment.keeps_bags:
            write_bag(fresh_folder(self.assignment.bags / each.name), seen, probe.recorders)
        return seen


def say(step: str) -> None:
    """Tell the command what happens now."""
    print(step, flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
