"""judge(lab, evidence) -> Verdict: pure; runs no node, and gives the same answer every time."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

from roslings.course import Lab
from roslings.course.grader import Experiment, experiments_of
from roslings.evidence import Evidence, ExperimentSeen, GradingSpan
from roslings.judge.dropped import LookedAt, watched
from roslings.judge.grader_mistakes import BadGrader, load_or_tell
from roslings.judge.unrecorded import NotRecordedView
from roslings.judge.views import ExperimentView, View, views_of
from roslings.seen.timeline import NS_PER_S, shares_s
from roslings.verdict import (
    CheckResult,
    Environment,
    Timings,
    Verdict,
    outcome_of,
    score_of,
)

if TYPE_CHECKING:
    from roslings.judge.plugin import Collector, Evidences

NO_PLUGINS = "PYTEST_DISABLE_PLUGIN_AUTOLOAD"


def judge(lab: Lab, evidence: Evidence, began_ns: int | None = None) -> Verdict:
    """Run the lab's checks on `evidence`. Raises BadGrader.

    The seconds are those from `began_ns` until now; by default, those that the evidence tells of.
    """
    return judge_later(lab, lambda: (evidence, began_ns))


def judge_later(lab: Lab, bring: Callable[[], tuple[Evidence, int | None]]) -> Verdict:
    """Load all that is judged by; then have `bring` bring the evidence, and judge it.

    `bring` brings `began_ns`, too, as `judge` has it. Raises BadGrader.
    """
    _ = lab.card, lab.hints, lab.hidden_checks
    declared = [each for grader in lab.graders for each in experiments_of(load_or_tell(grader))]
    views: dict[str, View] = {}
    looks = LookedAt()
    brought: list[tuple[Evidence, int | None]] = []
    timeline: list[GradingSpan] = []

    from roslings.judge.plugin import Evidences  # pytest takes long to load

    def fill() -> None:
        before_ns = time.monotonic_ns()
        brought.append(bring())
        judging.began_ns += time.monotonic_ns() - before_ns
        evidence, _ = brought[0]
        timeline.extend(evidence.timeline)
        views.update({each.name: _missing(each, evidence) for each in declared})
        views.update(views_of(watched(evidence, looks)))

    judging = GradingSpan(part="judging", of="", began_ns=time.monotonic_ns(), ended_ns=0)
    names = ("package", *(each.name for each in declared))
    results = run_checks(lab, Evidences(names, views, fill), looks)
    evidence, began_ns = brought[0]
    if began_ns is not None:
        judging.ended_ns = time.monotonic_ns()
        timeline.append(judging)
    return Verdict(
        lab=lab.name,
        package=evidence.package.name,
        outcome=outcome_of(results),
        score=score_of(results),
        checks=results,
        advice=tuple(evidence.advice),
        soak_s=evidence.soak.for_s if evidence.soak else 0.0,
        seconds=_timings(timeline, began_ns),
        environment=_environment(evidence),
    )


def run_checks(lab: Lab, evidences: Evidences, looks: LookedAt) -> tuple[CheckResult, ...]:
    """The outcome of every check, in the grader's order."""
    import pytest

    from roslings.judge.plugin import Collector, evidence_plugin

    collector = Collector(lab, looks, evidences.names)
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
        pytest.main(options, plugins=[evidence_plugin(evidences, collector), collector])
    _require_all(lab, collector)
    return collector.told


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


def _missing(each: Experiment, evidence: Evidence) -> View:
    """An experiment that was not made: none was, as nothing was built, or the grader is newer.

    One that nothing of ours observes is made only where the result is for others.
    """
    if evidence.experiments and not each.unobserved:
        return NotRecordedView(each.name)
    return ExperimentView(ExperimentSeen(name=each.name, clock="wall"))


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


def _timings(timeline: Sequence[GradingSpan], began_ns: int | None) -> Timings:
    ended_ns = max((span.ended_ns for span in timeline), default=0)
    if began_ns is None:
        began_ns = min((span.began_ns for span in timeline), default=0)
    shares = shares_s(timeline, began_ns, ended_ns)
    return Timings(
        reading=round(shares["reading"], 3),
        build=round(shares["building"], 3),
        discovery=round(shares["starting"], 3),
        watching=round(shares["watching"], 3),
        ending=round(shares["ending"], 3),
        judging=round(shares["judging"], 3),
        rest=round(shares[None], 3),
        total=round((ended_ns - began_ns) / NS_PER_S, 3),
    )


def _environment(evidence: Evidence) -> Environment:
    machine = evidence.machine
    clocks = sorted({e.clock for e in evidence.experiments.values()}) or ["wall"]
    return Environment(**machine.model_dump(), clock="+".join(clocks), seed=evidence.seed)
