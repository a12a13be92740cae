"""A node stays up in every run, whatever was thought of the run's clock."""

from __future__ import annotations

from typing import Literal

import pytest

from roslings.evidence import (
    Evidence,
    ExperimentSeen,
    MachineSeen,
    PackageSeen,
    ProcessSeen,
    Tick,
)
from roslings.experiment.measuring import to_outlive_s
from roslings.judge import ExperimentView, stay_up
from roslings.judge.faults import StoppedByItself
from roslings.judge.views import views_of

NS = 10**9
MACHINE = MachineSeen(
    roslings="", ros_distro="jazzy", rmw="", python="", platform="", isolation="namespace"
)


def run(clock: Literal["sim", "wall"], died_after_s: float | None, **words: str) -> ExperimentSeen:
    """A run of ten seconds; simulated ones are ten times as fast."""
    quicker = 10 if clock == "sim" else 1
    process = ProcessSeen(
        executable="talker",
        started_ns=0,
        ended_ns=int((10 if died_after_s is None else died_after_s) * NS / quicker),
        status=0 if died_after_s is None else 1,
        ended_by_itself=died_after_s is not None,
    )
    ticks = [
        Tick(sim_ns=50 * NS + s * NS, wall_ns=0, at_ns=s * NS // 10, kept_up=True)
        for s in range(11)
    ]
    return ExperimentSeen(
        name="talking",
        clock=clock,
        processes={"talker": process},
        ticks=ticks if clock == "sim" else [],
        **words,
    )


def view(last: ExperimentSeen, *before: ExperimentSeen) -> ExperimentView:
    """What a check looks at, of an experiment with earlier runs."""
    evidence = Evidence(
        lab="topics",
        seed=0,
        machine=MACHINE,
        build=None,
        experiments={"talking": last},
        package=PackageSeen(name="chatter", folder="chatter", build_type="ament_python"),
        attempts=list(before),
    )
    found = views_of(evidence)["talking"]
    assert isinstance(found, ExperimentView)
    return found


def test_a_death_counts_that_nobody_waited_for_in_real_time() -> None:
    """Its times tell nothing of a rate; that it ended tells of a node that ends."""
    died, shorter = run("sim", 8.0, not_believed="the node ended"), run("wall", None)
    shorter.processes["talker"].ended_ns = 7 * NS
    with pytest.raises(StoppedByItself) as fault:
        view(shorter, died).labelled("talker").must(stay_up)
    assert fault.value.measured == "it ended by itself after 8.0 s of simulated time (exit code 1)"


@pytest.mark.parametrize("after_s", [0.0, 8.0])
def test_a_death_in_simulated_time_is_not_told_of_who_outlives_it(after_s: float) -> None:
    """A node's clock shows 0 at its start there, and what died of that is no fault of the node."""
    died = run("sim", after_s, not_believed="the node ended")
    view(run("wall", None), died).labelled("talker").must(stay_up)


def test_where_both_runs_end_the_real_one_is_told() -> None:
    """In seconds that the student can count."""
    died = run("sim", 2.0, not_believed="the node ended")
    with pytest.raises(StoppedByItself) as fault:
        view(run("wall", 3.0), died).labelled("talker").must(stay_up)
    assert "3.0 s (exit code 1)" in fault.value.measured


def test_a_run_in_real_time_is_as_long_as_the_life_that_it_is_to_outlive() -> None:
    """Else nobody could tell whether the clock alone ended it."""
    assert to_outlive_s(run("sim", None)) == 0.0
    assert to_outlive_s(run("sim", 8.0)) > 8.0


def test_a_death_on_the_wall_is_told_in_its_seconds() -> None:
    """In the run that counts, or in one that a busy computer spoilt."""
    for last, before in (
        (run("wall", 3.0), run("sim", None, not_believed="too slow")),
        (run("wall", None), run("wall", 3.0, machine_fault="too busy")),
    ):
        with pytest.raises(StoppedByItself) as fault:
            view(last, before).labelled("talker").must(stay_up)
        assert fault.value.measured == "it ended by itself after 3.0 s (exit code 1)"


def test_who_stays_in_all_runs_stays() -> None:
    """Whether they were believed or not."""
    others = [run("sim", None, not_believed="too slow"), run("wall", None)]
    view(run("wall", None), *others).labelled("talker").must(stay_up)
