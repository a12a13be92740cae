"""Experiments that mostly wait run beside the others, and end with them."""

from __future__ import annotations

import threading

import pytest

from roslings.arena.lease import leased_domain
from roslings.evidence import ExperimentSeen
from roslings.experiment.alongside import Alongside
from roslings.experiment.declare import Experiment, experiment
from roslings.probe.probe import CalledOff, Probe


@experiment(alongside=True)
def waiting(scene: object) -> None:
    """Waits."""


def seen(each: Experiment) -> list[ExperimentSeen]:
    """A run in which nothing happened."""
    return [ExperimentSeen(name=each.name, clock="wall")]


def test_it_runs_while_the_others_run() -> None:
    """And its result is there at the end."""
    others_are_done = threading.Event()

    def run(each: Experiment, number: int) -> list[ExperimentSeen]:
        assert others_are_done.wait(60)
        return seen(each)

    with Alongside(run, lambda: None) as alongside:
        alongside.begin(waiting, 0)
        others_are_done.set()
        runs = alongside.runs_of(waiting)
    assert runs is not None and runs[0].name == "waiting"


def test_what_was_not_begun_has_no_runs() -> None:
    """It is then run in its order."""
    with Alongside(lambda each, number: seen(each), lambda: None) as alongside:
        assert alongside.runs_of(waiting) is None


def test_an_error_beside_it_calls_it_off() -> None:
    """Nobody waits half a minute for what nobody wants to know."""
    called_off = threading.Event()

    def run(each: Experiment, number: int) -> list[ExperimentSeen]:
        called_off.wait()
        raise CalledOff

    with pytest.raises(KeyboardInterrupt), Alongside(run, called_off.set) as alongside:
        alongside.begin(waiting, 0)
        raise KeyboardInterrupt


def test_its_own_error_reaches_the_others() -> None:
    """An experiment that cannot be made is no experiment without evidence."""

    def run(each: Experiment, number: int) -> list[ExperimentSeen]:
        raise RuntimeError("no arena")

    with (
        pytest.raises(RuntimeError, match="no arena"),
        Alongside(run, lambda: None) as alongside,
    ):
        alongside.begin(waiting, 0)
        alongside.runs_of(waiting)


def test_a_probe_that_is_called_off_ends_its_watch(monkeypatch: pytest.MonkeyPatch) -> None:
    """Within a look, not after its bound."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    nothing = ExperimentSeen(name="waiting", clock="wall")
    with leased_domain() as domain_id, Probe(domain_id, nothing, record=False) as probe:
        caller = threading.Timer(0.1, probe.call_off)
        caller.start()
        with pytest.raises(CalledOff):
            probe.until(lambda: False, 3600.0)
        caller.join()
