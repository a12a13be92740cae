"""judge(lab, evidence) -> Verdict: pure; runs no node, and gives the same answer every time."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from roslings.course import Lab
from roslings.course.files import CourseError
from roslings.evidence import Evidence, ExperimentSeen
from roslings.experiment.declare import experiments_of, load_grader
from roslings.judge.plugin import Collector, evidence_plugin
from roslings.judge.unrecorded import NotRecordedView
from roslings.judge.views import ExperimentView, View, views_of
from roslings.verdict import (
    CheckResult,
    Environment,
    Timings,
    Verdict,
    outcome_of,
    score_of,
)

NO_PLUGINS = "PYTEST_DISABLE_PLUGIN_AUTOLOAD"


class BadGrader(CourseError):
    """A grader's file cannot be used; the course's fault."""


def judge(lab: Lab, evidence: Evidence, total_s: float = 0.0) -> Verdict:
    """Run the lab's checks on `evidence`. Raises BadGrader."""
    results = run_checks(lab, evidence)
    return Verdict(
        lab=lab.name,
        package=evidence.package.name,
        outcome=outcome_of(results),
        score=score_of(results),
        checks=results,
        advice=tuple(evidence.advice),
        seconds=_timings(evidence, total_s),
        environment=_environment(evidence),
    )


def run_checks(lab: Lab, evidence: Evidence) -> tuple[CheckResult, ...]:
    """The outcome of every check, in the grader's order."""
    collector = Collector(lab)
    views = views_of(evidence)
    for name in (name for grader in lab.graders for name in _experiment_names(grader)):
        views.setdefault(name, _missing(name, evidence))
    options = [
        *map(str, lab.graders),
        "-c",
        os.devnull,
        "--rootdir",
        str(lab.grader.parent),
        f"--confcutdir={lab.grader.parent}",  # else pytest looks into every folder from / down
        "-o",
        "python_files=grade_*.py",
        "-p",
        "no:terminal",
        "-p",
        "no:cacheprovider",
        "-p",
        "no:unraisableexception",  # collects garbage ten times
        "-p",
        "no:threadexception",
        "-p",
        "no:xdist",
        "--noconftest",
        "--import-mode=importlib",
    ]
    for grader in lab.graders:
        sys.modules.pop(grader.stem, None)  # another course may have a grader of this name
    with _without_other_plugins():
        pytest.main(options, plugins=[evidence_plugin(views), collector])
    _require_all(lab, collector)
    return tuple(collector.results)


@contextmanager
def _without_other_plugins() -> Iterator[None]:
    """Whatever plugins are installed here: none takes part in a judgement, and none takes time.

    Loading them costs up to ten times as much as judging.
    """
    before = os.environ.get(NO_PLUGINS)
    os.environ[NO_PLUGINS] = "1"
    try:
        yield
    finally:
        del os.environ[NO_PLUGINS]
        if before is not None:
            os.environ[NO_PLUGINS] = before


def _missing(name: str, evidence: Evidence) -> View:
    """An experiment that was not made: none was, as nothing was built, or the grader is newer."""
    if evidence.experiments:
        return NotRecordedView(name)
    return ExperimentView(ExperimentSeen(name=name, clock="wall"))


def _experiment_names(grader: Path) -> list[str]:
    return [each.name for each in experiments_of(load_grader(grader))]


def _require_all(lab: Lab, collector: Collector) -> None:
    """Every check of the card was run, and no other. Raises BadGrader."""
    if collector.problems:
        raise BadGrader(f"{lab.grader}: {collector.problems[0]}")
    ran, worth = {result.id for result in collector.results}, set(lab.card.points)
    if ran != worth:
        raise BadGrader(
            f"{lab.grader}: the card gives points for {sorted(worth - ran) or 'all checks'},"
            f" and the grader has {sorted(ran - worth) or 'no check'} without points"
        )


def _timings(evidence: Evidence, total_s: float) -> Timings:
    experiments = evidence.experiments.values()
    return Timings(
        build=evidence.build.seconds if evidence.build else 0.0,
        discovery=round(sum(e.discovery_s for e in experiments), 3),
        watching=round(sum(e.watching_s for e in experiments), 3),
        ending=round(sum(e.ending_s for e in experiments), 3),
        total=round(total_s, 3),
    )


def _environment(evidence: Evidence) -> Environment:
    machine = evidence.machine
    clocks = sorted({e.clock for e in evidence.experiments.values()}) or ["wall"]
    return Environment(**machine.model_dump(), clock="+".join(clocks), seed=evidence.seed)
