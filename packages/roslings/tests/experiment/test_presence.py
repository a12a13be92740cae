"""What a complete node does not have is waited for once; what comes late is still found."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, cast

import pytest
from watching import watched

from ros2_on_pip.domain_lease import leased_domain
from roslings.arena import Arena
from roslings.evidence import ExperimentSeen, ProcessSeen
from roslings.experiment.own_time import OwnTime
from roslings.experiment.presence import GRACE_S, Absences, Presence
from roslings.probe import Probe
from skips import imported

imported("rclpy")
WITHIN_S = 30.0
LATE = Path(__file__).parent / "late"


class Program:
    """What an arena tells of a process: this one never waits for a processor."""

    alive = True
    seen = ProcessSeen(executable="it", started_ns=0)

    def waits_ns(self) -> dict[str, int]:
        """By thread."""
        return {"1": 0}


class Programs:
    """An arena with one process."""

    processes = (Program(),)

    def __init__(self) -> None:
        """It plays no device."""
        self.devices_ns = dict[str, int]()

    def devices_waits_ns(self) -> dict[str, int]:
        """What the threads of its devices waited for a processor."""
        return self.devices_ns

    def all_alive(self) -> bool:
        """It lives."""
        return True


ARENA = cast(Arena, Programs())


@pytest.fixture
def domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """A domain where nothing runs."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    with leased_domain() as leased:
        yield leased


@contextmanager
def probing(domain: int) -> Iterator[Probe]:
    """A probe of it."""
    seen = ExperimentSeen(name="x", clock="wall")
    with Probe(domain, seen, record=False) as probe:
        yield probe


@contextmanager
def node(domain: int, name: str = "it") -> Iterator[Any]:
    """A node, and the function that lets it spin."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor

    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain, signal_handler_options=None)
    made = rclpy.create_node(name, context=context)
    executor, over = SingleThreadedExecutor(context=context), threading.Event()
    executor.add_node(made)

    def live() -> None:
        while not over.is_set():
            executor.spin_once(timeout_sec=0.05)

    thread = threading.Thread(target=live)
    try:
        yield made, thread.start
    finally:
        over.set()
        if thread.is_alive():
            thread.join()
        executor.shutdown()
        made.destroy_node()
        context.try_shutdown()


def test_waiting_is_in_vain_only_for_a_complete_node(domain: int) -> None:
    """One that does not spin yet may still be in its constructor."""
    absences = Absences()
    with probing(domain) as probe, node(domain) as (_, begin):
        presence = Presence(probe, ARENA, absences)
        assert probe.until(lambda: bool(probe.seen.graph.nodes), WITHIN_S)
        assert not probe.until(lambda: presence.in_vain("a lamp"), GRACE_S * 1.5)
        begin()
        assert probe.until(lambda: presence.in_vain("a lamp"), WITHIN_S)
        assert not absences.holds(["it"], "a lamp")
        presence.note("a lamp", came=False)
    assert absences.holds(["it"], "a lamp")


def test_where_a_node_waited_for_a_processor_more_may_be_lost(domain: int) -> None:
    """What was announced, and not taken, is announced again after seconds."""
    programs = Programs()
    programs.devices_ns = {"7": 0}
    with probing(domain) as probe, node(domain) as (_, begin):
        presence = Presence(probe, cast(Arena, programs), Absences())
        begin()
        assert probe.until(lambda: bool(probe.seen.graph.nodes), WITHIN_S)
        assert not probe.until(lambda: presence.in_vain("a lamp"), GRACE_S / 3)
        programs.devices_ns = {"7": 500_000_000}
        assert not probe.until(lambda: presence.in_vain("a lamp"), GRACE_S * 2)
        assert probe.until(lambda: presence.in_vain("a lamp"), WITHIN_S)


def test_what_one_experiment_missed_no_other_waits_for(domain: int) -> None:
    """When its node is complete; for other things it has the whole time."""
    absences = Absences()
    absences.add(["it"], "a lamp")
    with probing(domain) as probe, node(domain) as (_, begin):
        presence = Presence(probe, ARENA, absences)
        assert probe.until(lambda: bool(probe.seen.graph.nodes), WITHIN_S)
        assert not presence.in_vain("a lamp")
        begin()
        long_s = 3600.0
        assert probe.until(lambda: presence.in_vain("a lamp", long_s), WITHIN_S)
        assert not presence.in_vain("a bell", long_s)


@pytest.mark.parametrize("first", ["came", "missed"])
def test_what_came_once_is_not_absent(first: str) -> None:
    """An experiment that was held up may have given it up too early; another one has seen it."""
    absences = Absences()
    steps = {"came": absences.came, "missed": absences.add}
    for name in sorted(steps, key=lambda name: name != first):
        steps[name](["it"], "a lamp")
    assert not absences.holds(["it"], "a lamp")
    absences.add(["it"], "a bell")
    assert absences.holds(["it"], "a bell")
    absences.came(["another"], "a bell")
    assert absences.holds(["it"], "a bell")


def test_what_a_busy_computer_did_not_see_is_waited_for_again() -> None:
    """Of that run's programs, and of no others."""
    absences = Absences()
    absences.add(["it"], "a bell")
    absences.add(["it", "another"], "a bell")
    absences.forget(["it"])
    assert not absences.holds(["it"], "a bell")
    assert absences.holds(["it", "another"], "a bell")


def test_a_clock_that_stands_still_tells_nothing_but_one_that_went_on_does(domain: int) -> None:
    """In simulated time only what was missed while that time went by is known for good."""
    absences = Absences()
    with probing(domain) as probe:
        presence = Presence(probe, ARENA, absences, simulated=True)
        presence.note("a lamp", came=False)
        presence.note_for_good("a bell")
    assert not absences.holds(["it"], "a lamp")
    assert absences.holds(["it"], "a bell")


def test_a_node_that_still_grows_is_not_complete(domain: int) -> None:
    """Its time begins again with each new thing."""
    from std_msgs.msg import Empty

    with probing(domain) as probe, node(domain) as (made, begin):
        presence = Presence(probe, ARENA, Absences())
        begin()
        assert probe.until(lambda: presence.in_vain("a bell"), WITHIN_S)
        made.create_publisher(Empty, "/lamp", 1)
        ends = len(probe.seen.graph.endpoints)
        assert probe.until(lambda: len(probe.seen.graph.endpoints) > ends, WITHIN_S)
        assert not presence.in_vain("a bell")


@pytest.mark.parametrize("script", ["slow_to_begin", "publisher_after_a_second"])
def test_a_node_that_is_late_is_heard(script: str) -> None:
    """Its constructor takes its time, or a timer makes what it publishes with."""
    last = watched(LATE / f"{script}.py", clock="wall")[-1]
    assert len(last.topics["/chatter"].messages) > 5


def test_what_the_devices_waited_is_not_a_nodes_own_time() -> None:
    """A node that waits for its camera is not silent by itself."""
    programs = Programs()
    programs.devices_ns = {"7": 1_000_000_000}
    own = OwnTime(cast(Arena, programs))
    assert own.is_past(0.0)
    programs.devices_ns = {"7": 61_000_000_000}
    assert own.waited_s() >= 60.0
    assert not own.is_past(0.0)


def test_what_was_waited_is_not_forgotten_when_the_process_goes() -> None:
    """Nothing is told of one that has just ended, until it is known that it has."""
    programs = Programs()
    programs.devices_ns = {"7": 1_000_000_000}
    own = OwnTime(cast(Arena, programs))
    programs.devices_ns = {"7": 61_000_000_000}
    assert own.waited_s() >= 60.0
    programs.devices_ns = {}
    assert own.waited_s() >= 60.0
