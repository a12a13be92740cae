"""Measure and judge one package, as `check` and `watch` do, in as little time as it takes.

What is independent goes on at once. The measuring process begins first, the package is read while
that goes behind its wall, and the judge is loaded while colcon builds.
"""

from __future__ import annotations

import random
import time
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.language import said
from ros2_on_pip.typed_paths import shown
from roslings.course import Lab
from roslings.evidence import Evidence, GradingSpan
from roslings.experiment import (
    MeasuringFailed,
    MeasuringOptions,
    MeasuringProcess,
    measuring_process,
)
from roslings.grading.saving import Graded
from roslings.workspace.inspect import inspect_package

if TYPE_CHECKING:
    from roslings.judge.loaded import Judge
    from roslings.verdict import Verdict

SEEDS = 10**9


def any_seed() -> int:
    """A seed that nobody can know before."""
    return random.SystemRandom().randrange(SEEDS)


class Ready:
    """All is done that needs no package; `grade` does the rest."""

    def __init__(self, lab: Lab, begun: MeasuringProcess, judge: Judge | None = None) -> None:
        """`judge` has loaded its sheet already; without one it is loaded while colcon builds."""
        self._lab, self._begun, self._judge = lab, begun, judge

    def grade(self, package: Path, began_ns: int, quiet: bool = False) -> Graded:
        """Measure a package and judge what was seen; its seconds count from `began_ns` on.

        Raises MeasuringFailed, GraderBroke, and whatever reading and staging the package raises.
        """
        from roslings.report.progress import ProgressLine

        with ProgressLine(quiet=quiet) as progress:
            progress.step(said("progress.reading", "Reading {package}", package=shown(package)))
            files = inspect_package(package, self._lab.card)
            read_ns = time.monotonic_ns()
            with mistakes_told(self._lab):
                evidence = self._begun.measure(package, files, progress.step, self._load_judge)
            reading = GradingSpan(
                part="reading", of=files.name, began_ns=began_ns, ended_ns=read_ns
            )
            evidence.timeline.insert(0, reading)
            progress.step(said("progress.judging", "Judging what was seen"))
            return Graded(self._lab, self._judged(evidence, began_ns), evidence)

    def _judged(self, evidence: Evidence, began_ns: int) -> Verdict:
        if self._judge:
            return self._judge(evidence, began_ns)
        from roslings.judge import judge

        return judge(self._lab, evidence, began_ns)

    def _load_judge(self) -> None:
        if self._judge:
            return
        from roslings.judge.preload import load_judge

        load_judge(self._lab.name)


@contextmanager
def mistakes_told(lab: Lab) -> Iterator[None]:
    """A block that measures: where it breaks off by a mistake in the grader, that is told.

    Raises GraderBroke in place of the MeasuringFailed of such a mistake.
    """
    try:
        yield
    except MeasuringFailed as failure:
        from roslings.judge.grader_mistakes import why_it_broke_off

        if mistake := why_it_broke_off(lab, failure.words):
            raise mistake from failure
        raise


@contextmanager
def ready(lab: Lab, choices: MeasuringOptions) -> Iterator[Ready]:
    """Ready for one package. It forks: begin before this process has threads."""
    with _judge_of(lab, choices) as judge, measuring_process(lab.name, choices) as begun:
        yield Ready(lab, begun, judge)


@contextmanager
def _judge_of(lab: Lab, choices: MeasuringOptions) -> Iterator[Judge | None]:
    """Of a stranger's package: one that has loaded its sheet before anything is built.

    It begins before the measuring process, whose pipes it must not hold.
    """
    if not choices.strangers:
        yield None
        return
    from roslings.judge.loaded import judge_loaded

    with judge_loaded(lab) as judge:
        yield judge


def ready_again_and_again(lab: Lab) -> Generator[Ready, None, None]:
    """Ready for one package after the other, with all loaded that is the same for each."""
    from roslings.experiment.preload import load_beforehand
    from roslings.judge.preload import load_judge

    load_beforehand(lab.name)
    load_judge(lab.name)
    while True:
        with ready(lab, MeasuringOptions(any_seed())) as each:
            yield each
