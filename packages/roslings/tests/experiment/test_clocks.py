"""Simulated time and the wall give the same answer, whatever the node takes its time from."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from recorded_evidence import recorded, view
from watching import HERE, RATE, TOPIC, watched

from ros2_on_pip.rates import NS_PER_S
from roslings.capabilities.topics.demands import have_rate
from roslings.course.grader import Clock
from roslings.evidence import ExperimentSeen
from roslings.experiment.clock_advice import advice_on_clocks
from roslings.experiment.watching import ENDED
from roslings.judge import come_up, stay_up
from roslings.judge.dropped import LookedAt, watched_experiment
from roslings.judge.faults import Fault, Inconclusive
from roslings.judge.views import ExperimentView
from until_told import until_told

pytestmark = pytest.mark.slow

STYLES = sorted((HERE / "styles").glob("*.py"))
FOLLOW_THE_CLOCK = ("composed", "functions", "looks_back", "timer", "two_nodes")
"""One thread, and a timer: these are judged in simulated time, on any machine."""

TRICKY = {
    "bursts": "Bursts",
    "bursts_of_a_thousand": "Bursts",
    "falls_silent": "FallsSilent",
    "large_messages": "right",
    "looks_back_at_its_start": "right",
    "no_parameter_services": "right",
    "one_hertz": "TooSlow",
    "publishes_clock": "right",
    "sets_use_sim_time_false": "right",
    "sleeping_thread": "TooFast",
    "slow_thread": "TooSlow",
    "steady_clock": "right",
    "stops_reading": "NoMessages",
    "ten_milliseconds": "TooFast",
    "ten_minutes": "NoMessages",
    "too_fast": "TooFast",
    "woken_by_anything": "right",
    "works_longer_than_its_period": "SleepsAfterWorking",
}
FILLS_THE_MACHINE = "large_messages"
"""Beside other work 20 MB a second are late by the machine's fault, and nothing can be told."""

CLOCKS: tuple[Clock, ...] = ("auto", "wall")


def answer(runs: Sequence[ExperimentSeen]) -> str:
    """What a check on the rate says of the run that counts."""
    looks = LookedAt()
    error = looks.outcome(_error(watched_experiment(runs[-1], looks)))
    if isinstance(error, Inconclusive):
        return "inconclusive"
    return type(error).__name__ if error else "right"


def _error(seen: ExperimentSeen) -> Fault | Inconclusive | None:
    try:
        ExperimentView(seen).topic(TOPIC).must(have_rate(TOPIC))
    except (Fault, Inconclusive) as error:
        return error
    return None


def settled(script: Path, clock: Clock, expected: str) -> str:
    """The answer; a busy computer may keep it back a while, but neither change nor hide it."""
    return until_told(
        lambda: answer(watched(script, clock)),
        lambda told: told == "inconclusive" != expected,
    )


def simulated(script: Path, hz: float = RATE.hz) -> ExperimentSeen:
    """A run in simulated time alone, which was believed; a busy computer may need another try."""
    runs = until_told(lambda: watched(script, hz=hz), lambda runs: len(runs) > 1)
    assert [(seen.clock, seen.not_believed) for seen in runs] == [("sim", None)]
    return runs[0]


@pytest.mark.slow
@pytest.mark.parametrize("clock", CLOCKS)
@pytest.mark.parametrize("style", STYLES, ids=lambda style: style.stem)
def test_correct_nodes_of_every_style_are_right(style: Path, clock: Clock) -> None:
    """By both clocks."""
    assert settled(style, clock, "right") == "right"


@pytest.mark.slow
@pytest.mark.parametrize("name", FOLLOW_THE_CLOCK)
def test_what_follows_the_clock_is_judged_by_it(name: str) -> None:
    """At once, and exactly."""
    seen = simulated(HERE / "styles" / f"{name}.py")
    rate = ExperimentView(seen).topic(TOPIC).rate
    assert rate is not None
    assert rate.hz == pytest.approx(RATE.hz)


def test_simulated_time_begins_where_a_computers_clock_stands() -> None:
    """So stamps look like real ones, and a node may reckon with the time before it started."""
    first = simulated(HERE / "styles" / "timer.py").ticks[0]
    assert 0 <= first.wall_ns - first.sim_ns < 2 * NS_PER_S


def test_what_ends_in_simulated_time_alone_is_judged_in_real_time() -> None:
    """A node's clock shows 0 until the first message on /clock: that is no fault of the node."""
    runs = watched(HERE / "tricky" / "looks_back_at_its_start.py")
    assert [seen.not_believed for seen in runs if seen.clock == "sim"] == [ENDED]
    view(runs).labelled("talker").must(come_up, stay_up)
    (said,) = advice_on_clocks(recorded(runs))
    assert "ValueError: Subtraction leads to negative time" in said


def test_a_slow_node_is_judged_by_the_clock_too() -> None:
    """Where six messages a second are asked and two come, they are watched for longer."""
    seen = simulated(HERE / "styles" / "timer.py", hz=3 * RATE.hz)
    rate = ExperimentView(seen).topic(TOPIC).rate
    assert rate is not None
    assert rate.hz == pytest.approx(RATE.hz, rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("clock", CLOCKS)
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=[pytest.mark.alone] if name == FILLS_THE_MACHINE else [])
        for name in TRICKY
    ],
)
def test_tricky_nodes_get_the_same_answer_by_both_clocks(name: str, clock: Clock) -> None:
    """What simulated time alone would judge wrongly, and what is hard to watch at all."""
    assert settled(HERE / "tricky" / f"{name}.py", clock, TRICKY[name]) == TRICKY[name]


@pytest.mark.slow
@pytest.mark.parametrize("clock", CLOCKS)
def test_a_topic_behind_many_is_heard_or_unclear_but_never_silent(clock: Clock) -> None:
    """Which topics are found first is chance; that there are too many is no fault of this one."""
    told = answer(watched(HERE / "tricky/behind_many_topics.py", clock))
    assert told in ("right", "inconclusive")


@pytest.mark.parametrize(
    "name", ["sleeping_thread", "works_longer_than_its_period", "steady_clock"]
)
def test_simulated_time_alone_is_not_believed(name: str) -> None:
    """Forced to it, the answer is neither right nor wrong."""
    seen = watched(HERE / "tricky" / f"{name}.py", "sim")[-1]
    assert seen.not_believed
    assert answer([seen]) in ("inconclusive", "NoMessages")
