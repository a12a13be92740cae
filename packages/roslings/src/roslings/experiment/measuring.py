"""In the measuring process: build the package, run the grader's experiments, write the evidence.

It writes one line of text a step to standard output, for the command to show.
"""

from __future__ import annotations

import functools
import os
import shutil
import signal
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field, replace
from types import FrameType
from typing import Literal

from roslings.arena import ArenaPlace, CannotStart, Installed, opened, ros_environment
from roslings.course import Card, lab
from roslings.course.grader import Experiment, experiments_of, load_grader
from roslings.evidence import (
    BuildSeen,
    Evidence,
    ExperimentSeen,
    GradingSpan,
    PackageSeen,
    evidence_json,
)
from roslings.experiment.alongside import MOST_AT_ONCE, Alongside
from roslings.experiment.assignment import Assignment
from roslings.experiment.clock_advice import advice_on_clocks, note_who_ignores_the_clock
from roslings.experiment.machine import look_at_machine
from roslings.experiment.middleware import note_a_deaf_node
from roslings.experiment.packets import Tap, tapped
from roslings.experiment.preload import load_beforehand
from roslings.experiment.presence import Absences
from roslings.experiment.scene import Scene
from roslings.experiment.soaking import SOAKING, Soak, soaking
from roslings.experiment.turns import Turns
from roslings.experiment.unobserved import Unobserved
from roslings.experiment.watching import ENDED
from roslings.probe import Probe
from roslings.probe.bag import fresh_folder, write_bag
from roslings.probe.budget import GRADING_BYTES, LARGE_BYTES, ByteBudget
from roslings.probe.raw_subscription import ALL_QUEUES_BYTES
from roslings.seen.exits import must_end_again, simulated_life_s
from roslings.seen.timeline import noted
from roslings.workspace.build import BuildRoom, build
from roslings.workspace.shared_build import shared_build
from roslings_rover.errors import DeviceTrouble

LARGE_TYPES = ("sensor_msgs/msg/Image", "sensor_msgs/msg/PointCloud2")
OUTLIVES_BY_S = 2.0
"""A timer speaks for the first time after a period there, and at once in simulated time."""
LONGEST_LIFE_S = 120.0
"""Longer than any watch of simulated time for a rate that a card asks for."""
MOST_RUNS = 3
"""A busy computer is given two more chances; then the verdict is inconclusive."""


class MeasuringStopped(BaseException):
    """The command wants this process to end: leave every block, and end what it started."""


def carry_out(assignment: Assignment, package: PackageSeen) -> None:
    """Measure, and put the evidence where the command looks for it; the process's whole life."""
    signal.signal(signal.SIGTERM, _stop)
    os.environ["ROS_LOG_DIR"] = str(assignment.folder / "log")  # not in the student's ~/.ros
    try:
        evidence = measure_here(assignment, package)
    except (DeviceTrouble, CannotStart) as trouble:
        sys.exit(str(trouble))
    assignment.evidence.write_bytes(evidence_json(evidence))


def _stop(number: int, frame: FrameType | None) -> None:
    raise MeasuringStopped


def measure_here(assignment: Assignment, package: PackageSeen) -> Evidence:
    """Build, and run the experiments."""
    task = lab(assignment.lab, assignment.hidden)
    if assignment.for_others:
        load_beforehand(assignment.lab, assignment.hidden)  # nothing a build does can change it
    timeline: list[GradingSpan] = []
    say(f"Building {package.name} with colcon")
    with noted(timeline, "building", package.name):
        seen, installed = _build(assignment, package, task.card.builds_within_s)
    evidence = Evidence(
        lab=task.name,
        seed=assignment.seed,
        machine=look_at_machine(assignment.wall, assignment.held_by),
        package=package,
        build=seen,
    )
    if installed:
        paced = carries_pictures(task.card)
        os.environ.update(ros_environment(assignment.wall, paced))
        stage = MeasuringContext(installed, assignment, task.card.ends_within_s, timeline, paced)
        declared = [
            each
            for file in task.graders
            for each in experiments_of(load_grader(file))
            if assignment.for_others or not each.unobserved
        ]
        _carry_out(
            stage, [] if assignment.only_soak else declared, evidence, _soak(stage, task.card)
        )
    evidence.timeline = timeline
    note_who_ignores_the_clock(evidence)
    evidence.advice.extend(advice_on_clocks(evidence))
    return evidence


def _soak(stage: MeasuringContext, card: Card) -> Soak | None:
    """What runs on in real time beside the experiments, where that was asked for."""
    for_s = stage.assignment.soak_s
    if not (for_s and any(node.stays for node in card.nodes)):
        return None
    return Soak(card, stage.installed, stage.place, stage.turns, for_s)


def _carry_out(
    stage: MeasuringContext, declared: Sequence[Experiment], evidence: Evidence, soak: Soak | None
) -> None:
    """All experiments, and what runs on beside them; the evidence has them in their order."""
    with soaking(soak) as soaked:
        for name, (*attempts, believed) in run_all(stage, declared).items():
            evidence.experiments[name] = believed
            evidence.attempts.extend(attempts)
        if soaked:
            say(SOAKING)
            evidence.soak = soaked.result()


def run_all(
    stage: MeasuringContext, declared: Sequence[Experiment]
) -> dict[str, list[ExperimentSeen]]:
    """All runs of each experiment, side by side; the one to be believed comes last.

    What is doubtful is made once more, when all are over.
    """
    with Alongside(stage.runs_of, stage.call_off, stage.at_once) as alongside:
        for number, each in enumerate(declared):
            alongside.begin(each, number)
        runs = {each.name: [*alongside.runs_of(each)] for each in declared}
        again = doubtful(declared, runs, stage.ends_within_s)
        for each in again:
            say("How a node ends is in doubt; once more, to be sure")
            alongside.begin(each, declared.index(each))
        for each in again:
            runs[each.name] += alongside.runs_of(each)
    return runs


def doubtful(
    declared: Sequence[Experiment], runs: Mapping[str, Sequence[ExperimentSeen]], limit_s: float
) -> list[Experiment]:
    """Those in which a node's end is in doubt, and no other run tells more of its program.

    Asked when all are over: most programs run in several experiments, and those agree.
    """
    every = [seen for each in runs.values() for seen in each]

    def is_alone(last: ExperimentSeen) -> bool:
        return must_end_again(last, [seen for seen in every if seen is not last], limit_s)

    return [each for each in declared if is_alone(runs[each.name][-1])]


def note_an_end(seen: ExperimentSeen) -> None:
    """What ended by itself in simulated time is run again in real time, before anything is said.

    Until the first step of its clock a node's time is 0, and a program may stumble over that alone.
    """
    ended = any(process.ended_by_itself for process in seen.processes.values())
    if seen.clock == "sim" and ended:
        seen.not_believed = seen.not_believed or ENDED


def to_outlive_s(simulated: ExperimentSeen) -> float:
    """So long a node must run in real time before an end in simulated time is the clock's alone."""
    lives_s = [
        simulated_life_s(process, simulated)
        for process in simulated.processes.values()
        if process.ended_by_itself
    ]
    return min(max(lives_s) + OUTLIVES_BY_S, LONGEST_LIFE_S) if lives_s else 0.0


def carries_pictures(card: Card) -> bool:
    """Its nodes send or hear messages that go in many pieces."""
    topics = (topic for node in card.nodes for topic in (*node.publishes, *node.subscribes))
    return any(topic.type in LARGE_TYPES for topic in topics)


def _build(
    assignment: Assignment, package: PackageSeen, within_s: float
) -> tuple[BuildSeen, Installed | None]:
    """Meanwhile, what the experiments need is loaded: colcon has a processor of its own."""
    source, place = assignment.source_of(package), assignment.place
    if assignment.builds:
        from_cache = assignment.builds_from_cache
        return shared_build(assignment.builds, source, assignment.room, place, within_s, from_cache)
    alone = BuildRoom(assignment.room, package.name)
    shutil.copytree(source, alone.source, symlinks=True)
    load = functools.partial(load_beforehand, assignment.lab, assignment.hidden)
    return build(alone, place, within_s, load)


@dataclass(frozen=True)
class MeasuringContext:
    """What every experiment of one package works with."""

    installed: Installed
    assignment: Assignment
    ends_within_s: float
    timeline: list[GradingSpan] = field(default_factory=list)
    """What was done when."""
    paced: bool = False
    """Whether its messages are larger than the network's buffers."""
    probes: set[Probe] = field(default_factory=set)
    """Those that watch now."""
    turns: Turns = field(default_factory=Turns)
    absences: Absences = field(default_factory=Absences)
    keeps: ByteBudget = field(default_factory=lambda: ByteBudget(GRADING_BYTES))
    """What the evidence of all experiments may take."""
    queues: ByteBudget = field(default_factory=lambda: ByteBudget(ALL_QUEUES_BYTES))
    """What the middleware may hold for those that watch now."""

    @property
    def at_once(self) -> int:
        """How many experiments run side by side: a real board is there for one at a time."""
        return MOST_AT_ONCE if self.assignment.port is None else 1

    @property
    def place(self) -> ArenaPlace:
        """Where the nodes of each experiment live."""
        return replace(self.assignment.place, paced=self.paced)

    def call_off(self) -> None:
        """Make all that watch end soon."""
        self.turns.call_off()
        for probe in set(self.probes):
            probe.call_off()

    def runs_of(
        self, each: Experiment, number: int, earlier: Sequence[ExperimentSeen]
    ) -> list[ExperimentSeen]:
        """Run an experiment until one run is to be believed; that one comes last."""
        say(f"Watching: {each.about}")
        return [*self.runs(each, number, earlier)]

    def runs(
        self, each: Experiment, number: int, earlier: Sequence[ExperimentSeen]
    ) -> Iterator[ExperimentSeen]:
        """One run after the other, as they are asked for, until one is to be believed."""
        choice, outlives_s = self.assignment.clock if each.clock == "auto" else "wall", 0.0
        if choice != "wall":
            yield (seen := self.run(each, "sim", number, earlier))
            if choice == "sim" or seen.not_believed is None or seen.prints_without_end:
                return
            outlives_s = to_outlive_s(seen)
        for _ in range(MOST_RUNS):
            yield (seen := self.run(each, "wall", number, earlier, outlives_s))
            if seen.machine_fault is None or seen.prints_without_end:
                return
            say("This computer was too busy to tell; once more")

    def run(
        self,
        each: Experiment,
        clock: Literal["sim", "wall"],
        number: int,
        earlier: Sequence[ExperimentSeen],
        outlives_s: float = 0.0,
    ) -> ExperimentSeen:
        """Run an experiment once, in a fresh arena; its nodes run for at least `outlives_s`."""
        seen = ExperimentSeen(name=each.name, clock=clock)
        if each.unobserved:
            with (
                opened(self.installed, self.place) as arena,
                self._reading_along(arena.domain_id) as tap,
            ):
                each.function(Unobserved(arena, seen, self.ends_within_s, tap), *earlier)
            return seen
        large_bytes = LARGE_BYTES if self.assignment.keeps_bags else 0
        with (
            opened(self.installed, self.place) as arena,
            Probe(
                arena.domain_id,
                seen,
                large_bytes=large_bytes,
                whole=self.keeps,
                queues=self.queues,
            ) as probe,
            self._watching(probe),
        ):
            seed, port = self.assignment.seed + number, self.assignment.port
            scene = Scene(
                arena,
                probe,
                seed,
                self.ends_within_s,
                port,
                self.turns,
                self.timeline,
                self.absences,
            )
            scene.outlives_s = outlives_s
            each.function(scene, *earlier)
        note_an_end(seen)
        note_a_deaf_node(seen)
        if seen.machine_fault:
            self.absences.forget(process.executable for process in seen.processes.values())
        if self.assignment.keeps_bags:
            write_bag(fresh_folder(self.assignment.bags / each.name), seen, probe.recorders)
        return seen

    def _reading_along(self, domain: int) -> AbstractContextManager[Tap | None]:
        """Where there is no wall, nodes speak through shared memory: no packet shows that."""
        return nullcontext() if self.assignment.wall == "domain" else tapped(domain)

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
