"""The measuring process: build the package, run the grader's experiments, write the evidence.

    python -m roslings.experiment.measuring ASSIGNMENT

It writes one line of text a step to standard output, for the command to show.
"""

from __future__ import annotations

import os
import shutil
import signal
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import Literal

from roslings.arena import CannotStart, Installed, kernel, opened, ros_environment
from roslings.course import lab
from roslings.devices.trouble import DeviceTrouble
from roslings.endings import must_end_again
from roslings.evidence import BuildSeen, Evidence, ExperimentSeen
from roslings.experiment.alongside import Alongside
from roslings.experiment.assignment import Assignment
from roslings.experiment.declare import Experiment, experiments_of, load_grader
from roslings.experiment.machine import look_at_machine
from roslings.experiment.run_folder import is_abandoned
from roslings.experiment.scene import Scene
from roslings.experiment.simulated import clock_publishers
from roslings.probe import Probe
from roslings.probe.bag import MOST_BYTES, fresh_folder, write_bag
from roslings.workspace.build import BuildRoom, build
from roslings.workspace.shared_build import shared_build

MOST_RUNS = 3
"""A busy computer is given two more chances; then the verdict is inconclusive."""


class Stopped(BaseException):
    """The command wants this process to end: leave every block, and end what it started."""


def main(path: Path) -> None:
    """Measure what the file at `path` asks for."""
    kernel.die_with_parent()
    assignment = Assignment.model_validate_json(path.read_text("utf-8"))
    if not is_abandoned(assignment.folder):
        carry_out(assignment)


def carry_out(assignment: Assignment) -> None:
    """Measure, and put the evidence where the command looks for it; the process's whole life."""
    signal.signal(signal.SIGTERM, _stop)
    os.environ.update(ros_environment(assignment.wall))
    os.environ["ROS_LOG_DIR"] = str(assignment.folder / "log")  # not in the student's ~/.ros
    try:
        evidence = measure_here(assignment)
    except (DeviceTrouble, CannotStart) as trouble:
        sys.exit(str(trouble))
    assignment.evidence.write_text(evidence.model_dump_json(by_alias=True), "utf-8")


def _stop(number: int, frame: FrameType | None) -> None:
    raise Stopped


def measure_here(assignment: Assignment) -> Evidence:
    """Build, and run the experiments in their order."""
    task = lab(assignment.lab, assignment.hidden)
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
        declared = [each for file in task.graders for each in experiments_of(load_grader(file))]
        _run_all(stage, declared, evidence)
    evidence.advice.extend(advice_on_clocks(evidence))
    return evidence


def _run_all(stage: Stage, declared: Sequence[Experiment], evidence: Evidence) -> None:
    """Run the experiments in their order, beside those that mostly wait."""
    with Alongside(stage.run_alone, stage.call_off) as alongside:
        for number, each in enumerate(declared):
            if stage.runs_alongside(each):
                say(f"Watching meanwhile: {each.about}")
                alongside.begin(each, number)
        for number, each in enumerate(declared):
            runs = alongside.runs_of(each)
            if runs is None:
                say(f"Watching: {each.about}")
                runs = stage.runs_of(each, number, _asked_for(each, evidence))
            *attempts, evidence.experiments[each.name] = runs
            evidence.attempts.extend(attempts)


def _asked_for(each: Experiment, evidence: Evidence) -> list[ExperimentSeen]:
    return [evidence.experiments[name] for name in each.needs]


def advice_on_clocks(evidence: Evidence) -> list[str]:
    """What a student learns from a run in simulated time that was not believed."""
    found: list[str] = []
    for seen in evidence.attempts:
        if seen.ignores_clock and _would_have_spoken(evidence.experiments[seen.name]):
            names = ", ".join(sorted(set(seen.graph.nodes)))
            found.append(
                f"{names} does not follow simulated time (/clock), so it was watched in real"
                " time. A timer of create_timer() follows it; time.sleep() and threads do not."
            )
        found += [
            f"{node} publishes on /clock. That is for a simulator: it sets the time of all nodes."
            for node in clock_publishers(seen)
        ]
    return list(dict.fromkeys(found))


def _would_have_spoken(seen: ExperimentSeen) -> bool:
    """It has something to say, and no error of its own kept it from saying it."""
    spoke = any(topic.messages for topic in seen.topics.values())
    return spoke and not any(process.ended_by_itself for process in seen.processes.values())


def _build(assignment: Assignment, package: str) -> tuple[BuildSeen, Installed | None]:
    source = assignment.folder / "src" / package
    if assignment.builds:
        return shared_build(assignment.builds, source, assignment.room, assignment.place)
    room = BuildRoom(assignment.room, package)
    shutil.copytree(source, room.source, symlinks=True)
    return build(room, assignment.place)


@dataclass(frozen=True)
class Stage:
    """What every experiment of one package works with."""

    installed: Installed
    assignment: Assignment
    ends_within_s: float
    probes: set[Probe] = field(default_factory=set)
    """Those that watch now."""

    def runs_alongside(self, each: Experiment) -> bool:
        """Whether it runs beside others: a real board is there for one at a time."""
        return each.alongside and self.assignment.port is None

    def run_alone(self, each: Experiment, number: int) -> list[ExperimentSeen]:
        """Run an experiment that asks for no other's evidence."""
        return self.runs_of(each, number, ())

    def call_off(self) -> None:
        """Make all that watch end soon."""
        for probe in set(self.probes):
            probe.call_off()

    def runs_of(
        self, each: Experiment, number: int, earlier: Sequence[ExperimentSeen]
    ) -> list[ExperimentSeen]:
        """Run an experiment until one run is to be believed; that one comes last.

        Where a node ended badly in it, all that once more.
        """
        runs = [*self._until_believed(each, number, earlier)]
        if must_end_again(runs[-1], [*earlier, *runs[:-1]], self.ends_within_s):
            say("A node did not end well; once more, to be sure")
            runs += self._until_believed(each, number, earlier)
        return runs

    def _until_believed(
        self, each: Experiment, number: int, earlier: Sequence[ExperimentSeen]
    ) -> Iterator[ExperimentSeen]:
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
        with (
            opened(self.installed, self.assignment.place) as arena,
            Probe(arena.domain_id, seen, large_bytes=large_bytes) as probe,
            self._watching(probe),
        ):
            seed, port = self.assignment.seed + number, self.assignment.port
            scene = Scene(arena, probe, seed, self.ends_within_s, port)
            each.function(scene, *earlier)
        if self.assignment.keeps_bags:
            write_bag(fresh_folder(self.assignment.bags / each.name), seen, probe.recorders)
        return seen

    @contextmanager
    def _watching(self, probe: Probe) -> Iterator[None]:
        self.probes.add(probe)
        try:
            yield
        finally:
            self.probes.discard(probe)


def say(step: str) -> None:
    """Tell the command what happens now."""
    print(step, flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
