"""No node fills the memory of those who watch it, and none sings in the canary's place."""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from ros2_on_pip.domain_lease import leased_domain
from roslings.course.contract import RateContract
from roslings.evidence import CanarySeen, ExperimentSeen, MessageSeen
from roslings.experiment.on_the_wall import trouble
from roslings.probe import Probe, budget
from roslings.probe.budget import GRADING_BYTES, ByteBudget, Store, size_of
from roslings.probe.content import message_class
from roslings.probe.graph import Looker
from roslings.probe.raw_subscription import (
    OWN_BYTES,
    QUEUE_BYTES,
    RawSubscription,
    SubscriptionQueues,
)
from roslings.probe.recorder import LARGEST_CONTENT, MESSAGE_BYTES, MOST_MESSAGES, TEXT_BYTES
from skips import imported

imported("rclpy")
MANY_HZ = 15
WITHIN_S = 30.0
PICTURE_BYTES = 640 * 480 * 3


@pytest.fixture
def domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """A domain where nothing runs."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    with leased_domain() as number:
        yield number


@pytest.fixture
def flooder(domain: int) -> Iterator[Any]:
    """The node of a package that knows no measure."""
    import rclpy
    from rclpy.node import Node

    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain, signal_handler_options=None)
    node = Node("flooder", context=context)
    yield node
    node.destroy_node()
    context.try_shutdown()


def watched(domain: int, act: Callable[[Probe], None]) -> ExperimentSeen:
    """What a probe keeps while something is done."""
    seen = ExperimentSeen(name="flood", clock="wall")
    with Probe(domain, seen, whole=ByteBudget(GRADING_BYTES)) as probe:
        act(probe)
    return seen


# --- one budget for all kinds ------------------------------------------------------------------


def test_what_is_counted_is_what_it_takes() -> None:
    """In memory and as JSON, and not several times as much."""
    tracemalloc.start()
    messages = [
        MessageSeen(
            source_ns=10**18 + n,
            sequence=10**6 + n,
            arrival_ns=10**15 + n,
            size=300 + n,
            content={"data": f"Hello {n}", "list": [float(n), n, "\x01" * 9], "deep": {"x": {}}},
        )
        for n in range(1000)
    ]
    taken, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    seen = ExperimentSeen(name="it", clock="wall", canary=CanarySeen(wanted_hz=1.0))
    empty = len(seen.model_dump_json())
    assert seen.canary
    seen.canary.messages = messages
    written = len(seen.model_dump_json()) - empty
    assert taken + written <= sum(map(size_of, messages)) <= 2 * (taken + written)


def test_a_flood_silences_no_other() -> None:
    """Each has bytes of its own; what once found no room keeps out all after it."""
    shared = ByteBudget(100)
    quiet, loud = budget.Share(shared, 20), budget.Share(shared, 20)
    assert [loud.take(20) for _ in range(5)] == [True, True, True, True, False]
    assert not loud.take(1)
    assert [quiet.take(10) for _ in range(3)] == [True, True, False]


def test_what_is_not_needed_is_given_back() -> None:
    """An experiment that kept little leaves the rest to those after it."""
    whole = ByteBudget(1000)
    store = Store(whole)
    share = store.share(400)
    assert share.take(300)
    assert whole.left == 600
    store.close()
    assert whole.left == 700


def test_experiments_leave_room_for_those_after_them() -> None:
    """However much each of many runs takes, the next one has some room, and all fit together."""
    whole, taken = ByteBudget(GRADING_BYTES), 0
    for _ in range(12):
        store = Store(whole)
        most = store.budget.left
        assert most > 8 * 1024
        assert store.budget.take(most)
        taken += most
    assert taken <= GRADING_BYTES


def test_an_honest_package_does_not_notice() -> None:
    """Room for 1000 Hz, as long as messages are counted at all, and for two minutes of odometry."""
    from nav_msgs.msg import Odometry

    short, odometry = 40, budget_of(Odometry())
    assert MOST_MESSAGES * (MESSAGE_BYTES + TEXT_BYTES + 3 * short) < Store().budget.left
    assert 50 * 60 * odometry < Store().budget.left


def budget_of(message: Any) -> int:
    """What a message takes."""
    from rclpy.serialization import serialize_message

    from roslings.probe.content import to_plain

    raw = len(serialize_message(message))
    return MESSAGE_BYTES + max(TEXT_BYTES + 3 * raw, raw + size_of(to_plain(message)))


# --- what a node sends -------------------------------------------------------------------------


def test_logs_are_bounded_in_bytes(
    domain: int, flooder: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever their names; the rest is told."""
    from rcl_interfaces.msg import Log
    from rclpy.qos import DurabilityPolicy, QoSProfile

    monkeypatch.setattr(budget, "EXPERIMENT_BYTES", 6 * budget.MB)
    quality = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    publisher = flooder.create_publisher(Log, "/rosout", quality)

    def flood(probe: Probe) -> None:
        def dropped() -> bool:
            for number in range(20):
                publisher.publish(Log(name=f"name{number}", msg="<\x01>" * 700))
            return probe.store.dropped("rosout") > 50

        assert probe.until(dropped, WITHIN_S)

    seen = watched(domain, flood)
    kept = sum(size_of(line) for lines in seen.rosout.values() for line in lines)
    assert budget.MB < kept < 6 * budget.MB
    assert len(seen.model_dump_json()) < 6 * budget.MB
    assert [(each.kind, each.count > 50) for each in seen.dropped] == [("rosout", True)]


def test_messages_are_bounded_in_bytes(
    domain: int, flooder: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A loud topic is cut off; a quiet one beside it is whole, with its contents."""
    from std_msgs.msg import String

    monkeypatch.setattr(budget, "EXPERIMENT_BYTES", 6 * budget.MB)
    loud = flooder.create_publisher(String, "/loud", 10)
    quiet = flooder.create_publisher(String, "/quiet", 10)

    def flood(probe: Probe) -> None:
        assert probe.until(lambda: probe.connected("/quiet") and probe.connected("/loud"), WITHIN_S)

        def dropped() -> bool:
            for _ in range(10):
                loud.publish(String(data="x" * 50_000))
            return probe.store.dropped("messages") > 5

        assert probe.until(dropped, WITHIN_S)
        for number in range(10):
            quiet.publish(String(data=f"it {number}"))
        assert probe.until(lambda: probe.count("/quiet") == 10, WITHIN_S)

    seen = watched(domain, flood)
    heard = seen.topics["/quiet"]
    assert [m.content["data"] for m in heard.messages] == [f"it {n}" for n in range(10)]
    assert (heard.not_kept, heard.not_read) == (0, 0)
    assert seen.topics["/loud"].not_kept > 5
    assert size_of(seen.topics["/loud"].messages) < 6 * budget.MB
    assert [each.kind for each in seen.dropped] == ["messages"]


def test_a_message_too_large_to_read_is_told(domain: int, flooder: Any) -> None:
    """It counts; what it says is not known."""
    from std_msgs.msg import String

    publisher = flooder.create_publisher(String, "/large", 10)

    def say(probe: Probe) -> None:
        assert probe.until(lambda: probe.connected("/large"), WITHIN_S)
        publisher.publish(String(data="x" * (LARGEST_CONTENT + 1)))
        assert probe.until(lambda: probe.count("/large") == 1, WITHIN_S)

    heard = watched(domain, say).topics["/large"]
    assert (heard.messages[0].content, heard.not_read, heard.not_kept) == (None, 1, 0)


def test_a_large_graph_is_cut_and_told(domain: int, flooder: Any) -> None:
    """Nodes first, then endpoints, as many as find room."""
    from std_msgs.msg import String

    for number in range(100):
        flooder.create_publisher(String, f"/many{number}_{'x' * 100}", 10)
    seen = ExperimentSeen(name="graph", clock="wall")
    with Probe(domain, seen, record=False) as probe:
        small = Looker(probe.node, most_bytes=40_000)
        assert probe.until(lambda: len(Looker(probe.node).read().endpoints) > 100, WITHIN_S)
        graph = small.read()
    assert "/flooder" in graph.nodes
    assert 10 < len(graph.endpoints) < 50
    assert size_of(graph) < 41_000
    assert small.left_out > 50


# --- what the middleware holds for us ----------------------------------------------------------


def test_a_queue_of_large_messages_is_made_shorter(domain: int, flooder: Any) -> None:
    """Where they pile up: as long as some bytes allow, and still one that hears."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.node import Node
    from rclpy.qos import QoSProfile
    from std_msgs.msg import String

    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain, signal_handler_options=None)
    node = Node("_ear", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    sizes: list[int] = []
    subscription = RawSubscription(
        node,
        String,
        "/big",
        lambda raw, info: sizes.append(len(raw)),
        QoSProfile(depth=5000),
        SubscriptionQueues(),
    )
    publisher = flooder.create_publisher(String, "/big", 5)
    big = String(data="x" * 1_000_000)
    try:
        while not subscription.cut_short:
            publisher.publish(big)
            publisher.publish(big)
            executor.spin_once(timeout_sec=0.01)
        assert subscription.depth == QUEUE_BYTES // sizes[-1]
        before = len(sizes)
        while len(sizes) == before:
            publisher.publish(big)
            executor.spin_once(timeout_sec=0.01)
    finally:
        executor.shutdown()
        node.destroy_node()
        context.try_shutdown()


@pytest.mark.parametrize(
    ("kind", "wanted", "size"),
    [("std_msgs/msg/String", 5000, 44), ("sensor_msgs/msg/Image", 32, PICTURE_BYTES)],
)
def test_an_honest_queue_stays_as_it_is(flooder: Any, kind: str, wanted: int, size: int) -> None:
    """Texts at 1000 Hz, and pictures at 15 Hz: two seconds of them may wait."""
    from rclpy.qos import QoSProfile

    subscription = RawSubscription(
        flooder,
        message_class(kind),
        "/it",
        lambda raw, info: None,
        QoSProfile(depth=5000),
        SubscriptionQueues(),
    )
    assert subscription.depth == wanted
    assert wanted * size < (OWN_BYTES if size < 100 else QUEUE_BYTES)
    late = {"received_timestamp": 1}
    subscription._hear(bytes(size), late)
    assert (subscription.depth, subscription.cut_short) == (wanted, False)


# --- the canary --------------------------------------------------------------------------------


def seen(imitated: bool) -> ExperimentSeen:
    """A canary that sang 15 times a second, and was asked for 2."""
    stamps = [1 + number * 10**9 // MANY_HZ for number in range(60)]
    messages = [
        MessageSeen(source_ns=ns, sequence=number, arrival_ns=ns, size=4)
        for number, ns in enumerate(stamps)
    ]
    canary = CanarySeen(wanted_hz=2.0, messages=messages, imitated=imitated)
    return ExperimentSeen(name="it", clock="wall", canary=canary)


def test_a_canary_that_is_imitated_excuses_nothing() -> None:
    """Or a wrong rate could hide behind a wrong song."""
    limit = RateContract(hz=2.0, within=0.05)
    assert "known to be good" in (trouble(seen(imitated=False), None, limit) or "")
    assert trouble(seen(imitated=True), None, limit) is None
