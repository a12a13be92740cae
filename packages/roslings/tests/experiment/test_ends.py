"""A bad end is looked at a second time: it is a fault where it comes twice."""

from __future__ import annotations

import pytest
from watching import HERE, NODE, watched

from roslings.course.grader import Clock
from roslings.evidence import Ending, ExperimentSeen, ProcessSeen
from roslings.experiment import Scene, experiment
from roslings.experiment.measuring import doubtful
from roslings.judge import end_within, exit_cleanly
from roslings.judge.faults import Inconclusive, UncleanExit
from roslings.judge.views import ExperimentView, ProcessView

pytestmark = pytest.mark.slow

ENDS_WITHIN_S = 2.0


def ended(name: str, clock: Clock = "auto") -> ProcessView:
    """The process of a script that was run twice, since its first end was in doubt."""
    first, second = watched(HERE / "ends" / f"{name}.py", clock)
    return ExperimentView(second, (first,)).process(NODE)


def test_an_error_that_comes_each_time_is_a_fault() -> None:
    """The same is seen twice."""
    with pytest.raises(UncleanExit, match="exit code 3"):
        ended("with_an_error").must(end_within(ENDS_WITHIN_S), exit_cleanly)


def test_a_late_end_that_comes_once_is_unclear() -> None:
    """Whatever kept it: the computer, or the student's code."""
    with pytest.raises(Inconclusive, match="talker ended late in one of two runs"):
        ended("late_once").must(end_within(ENDS_WITHIN_S))


def test_a_second_shutdown_that_a_race_has_hidden_is_a_fault() -> None:
    """The first run ends inside rclpy, the second shows what the node does after it."""
    with pytest.raises(UncleanExit, match="exit code 1"):
        ended("in_a_race_once", "wall").must(exit_cleanly)


@experiment
def alone(scene: Scene) -> None:
    """The talker alone."""


@experiment
def together(scene: Scene) -> None:
    """The talker beside another."""


def bad(name: str, executable: str = "talker") -> ExperimentSeen:
    """A run in which a program ended with an error."""
    ending = Ending(signal="SIGINT", after_s=0.1, watched_s=0.1)
    process = ProcessSeen(executable=executable, started_ns=0, status=3, ending=ending)
    return ExperimentSeen(name=name, clock="wall", processes={executable: process})


def test_a_bad_end_is_looked_at_again_where_no_other_experiment_shows_the_same() -> None:
    """Two of one program agree; of two programs, each is alone."""
    declared = [alone, together]
    agreed = {"alone": [bad("alone")], "together": [bad("together")]}
    assert doubtful(declared, agreed, ENDS_WITHIN_S) == []
    apart = {"alone": [bad("alone")], "together": [bad("together", "listener")]}
    assert doubtful(declared, apart, ENDS_WITHIN_S) == declared
