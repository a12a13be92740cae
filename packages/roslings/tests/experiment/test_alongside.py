"""Experiments run side by side, take turns, and end together."""

from __future__ import annotations

import threading
from collections.abc import Sequence

import pytest

from ros2_on_pip.domain_lease import leased_domain
from roslings.course.grader import Experiment, experiment
from roslings.evidence import ExperimentSeen
from roslings.experiment.alongside import Alongside, Runs
from roslings.experiment.turns import Turns
from roslings.probe.probe import CalledOff, Probe

LONG_S = 60.0
"""Only who hangs waits so long."""


@experiment
def waiting(scene: object) -> None:
    """Waits."""


@experiment
def quick(scene: object) -> None:
    """Waits for nobody."""


@experiment
def asking(scene: object, waiting: ExperimentSeen, quick: ExperimentSeen) -> None:
    """Asks for what the others saw."""


def seen(each: Experiment) -> list[ExperimentSeen]:
    """A run in which nothing happened."""
    return [ExperimentSeen(name=each.name, clock="wall")]


def test_they_run_side_by_side() -> None:
    """Each waits here until the other has begun as well."""
    both = threading.Barrier(2, timeout=LONG_S)

    def run(each: Experiment, number: int, earlier: Runs) -> Runs:
        both.wait()
        return seen(each)

    with Alongside(run, lambda: None) as alongside:
        alongside.begin(waiting, 0)
        alongside.begin(quick, 1)
        names = [alongside.runs_of(each)[0].name for each in (waiting, quick)]
    assert names == ["waiting", "quick"]


@pytest.mark.parametrize("at_once", [1, 8])
def test_who_asks_for_others_gets_the_runs_that_are_to_be_believed(at_once: int) -> None:
    """The last of each, in the order of asking; also where one runs at a time."""
    got: list[Sequence[ExperimentSeen]] = []

    def run(each: Experiment, number: int, earlier: Runs) -> Runs:
        got.append(earlier)
        first = ExperimentSeen(name=each.name, clock="wall", machine_fault="busy")
        return [first, *seen(each)]

    with Alongside(run, lambda: None, at_once) as alongside:
        for number, each in enumerate((waiting, quick, asking)):
            alongside.begin(each, number)
    assert [(one.name, one.machine_fault) for one in got[-1]] == [
        ("waiting", None),
        ("quick", None),
    ]


def test_an_error_beside_it_calls_it_off() -> None:
    """Nobody waits half a minute for what nobody wants to know."""
    called_off = threading.Event()

    def run(each: Experiment, number: int, earlier: Runs) -> Runs:
        called_off.wait()
        raise CalledOff

    with pytest.raises(KeyboardInterrupt), Alongside(run, called_off.set) as alongside:
        alongside.begin(waiting, 0)
        raise KeyboardInterrupt


def test_its_own_error_reaches_the_others() -> None:
    """An experiment that cannot be made is no experiment without evidence."""

    def run(each: Experiment, number: int, earlier: Runs) -> Runs:
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


# --- turns -------------------------------------------------------------------------------------


def test_nobody_starts_while_another_is_timed() -> None:
    """Who wants to start waits for the end of the timed stretch."""
    turns, order = Turns(), list[str]()

    def start() -> None:
        coming.set()
        with turns.busy():
            order.append("started")

    coming = threading.Event()
    starting = threading.Thread(target=start)
    with turns.timed():
        starting.start()
        assert coming.wait(LONG_S)
        order.append("timed")
    starting.join(LONG_S)
    assert order == ["timed", "started"]


def test_nobody_is_timed_while_another_starts() -> None:
    """And who waits to start goes first."""
    turns, order = Turns(), list[str]()

    def watch() -> None:
        coming.set()
        with turns.timed():
            order.append("timed")

    coming = threading.Event()
    watching = threading.Thread(target=watch)
    with turns.busy():
        watching.start()
        assert coming.wait(LONG_S)
        order.append("started")
    watching.join(LONG_S)
    assert order == ["started", "timed"]


def test_timed_stretches_run_side_by_side() -> None:
    """Each waits here until the other is there, too."""
    turns, both = Turns(), threading.Barrier(2, timeout=LONG_S)

    def watch() -> None:
        with turns.timed():
            both.wait()

    other = threading.Thread(target=watch)
    other.start()
    watch()
    other.join(LONG_S)


def test_a_turn_of_its_own_is_enough() -> None:
    """An experiment may start another node within its own timed stretch."""
    turns = Turns()
    with turns.timed(), turns.busy(), turns.timed():
        pass
    with turns.busy(), turns.timed():
        pass


def test_who_waits_for_a_turn_can_be_called_off() -> None:
    """Else Ctrl-C would wait for a stretch of half a minute."""
    turns, ends = Turns(), list[str]()

    def start() -> None:
        try:
            with turns.busy():
                ends.append("started")
        except CalledOff:
            ends.append("called off")

    with turns.timed():
        starting = threading.Thread(target=start)
        starting.start()
        turns.call_off()
        starting.join(LONG_S)
    assert ends == ["called off"]
