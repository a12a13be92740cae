"""Who does what a fault of quality of service advises passes, and hears of the right endpoint.

A table of all that a card can ask and all that can be seen. The advice is taken out of the fault,
run as Python with rclpy's own words, and put into the endpoint; then it is judged again.
"""

from __future__ import annotations

import inspect
import itertools
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, get_args

import pytest

import roslings
from roslings.capabilities.qos import demands as times
from roslings.capabilities.qos import faults as of_times
from roslings.capabilities.qos.contract import AskContract, Liveliness, OfferContract, TimesContract
from roslings.capabilities.qos.record import JoinSeen, QosSeen
from roslings.course import NodeContract, QosContract, TopicContract, all_labs, root
from roslings.evidence import Endpoint, ExperimentSeen, GraphSeen, Qos
from roslings.judge import ExperimentView, have_just_this_qos, match_qos
from roslings.judge.faults import (
    CALLS,
    EndpointKind,
    Fault,
    MatchedPolicies,
    python_words,
    qos_conflicts,
)
from roslings.judge.faults.qos import OtherQos
from roslings_learn.drills.course import all_drills
from skips import imported

rclpy_qos = imported("rclpy.qos")
KINDS: tuple[EndpointKind, ...] = get_args(EndpointKind)
PAIRS = [
    MatchedPolicies(*pair)
    for pair in itertools.product(("reliable", "best_effort"), ("volatile", "transient_local"))
]
TOPIC, OTHER = "/heard", "/other"
NODE = NodeContract(node="/it", executable="it")
S = 10**9
ENGINE, GRADERS = Path(roslings.__file__).parent, root() / "graders"


def words_of_rclpy() -> dict[str, Any]:
    """What the advice may name: all of these stand in rclpy."""
    from rclpy.duration import Duration

    names = (
        "DurabilityPolicy",
        "LivelinessPolicy",
        "QoSProfile",
        "ReliabilityPolicy",
        "qos_profile_sensor_data",
    )
    return {"Duration": Duration, **{name: getattr(rclpy_qos, name) for name in names}}


def run(advice: str) -> Any:
    """As the student's program would. A number is a profile, as for create_publisher."""
    value = eval(advice, {"__builtins__": {}}, words_of_rclpy())
    return rclpy_qos.QoSProfile(depth=value) if isinstance(value, int) else value


def policies_of(profile: Any) -> MatchedPolicies:
    """What the middleware would tell of it."""
    return MatchedPolicies(profile.reliability.name.lower(), profile.durability.name.lower())


def view(kind: EndpointKind, qos: Qos, part: QosSeen | None = None) -> ExperimentView:
    """A graph with this one endpoint, and another one with all that is usual."""
    ends = [
        Endpoint(kind=kind, node="/it", topic=topic, type="std_msgs/msg/Bool", qos=each, gid=topic)
        for topic, each in ((TOPIC, qos), (OTHER, Qos()))
    ]
    parts = {"qos": part} if part else {}
    graph = GraphSeen(nodes=["/it"], endpoints=ends, services={})
    return ExperimentView(ExperimentSeen(name="x", clock="wall", graph=graph, parts=parts))


def fault_of(demand: Callable[[ExperimentView], None], seen: ExperimentView) -> Fault | None:
    """The one that is raised; None where it passes."""
    try:
        demand(seen)
    except Fault as fault:
        return fault
    return None


# --- reliability and durability ----------------------------------------------------------------


def judged(
    asked: MatchedPolicies, exact: bool, kind: EndpointKind
) -> Callable[[ExperimentView], None]:
    """What each lab and each drill asks of an endpoint with this card."""
    contract = TopicContract(
        topic=TOPIC,
        type="std_msgs/msg/Bool",
        qos=QosContract.model_validate({**asked.policies, "exact": exact}),
    )
    demand = have_just_this_qos if exact else match_qos

    def look(seen: ExperimentView) -> None:
        end = seen.publisher if kind == "publisher" else seen.subscription
        end(NODE, contract).must(demand)

    return look


def seen_as(pair: MatchedPolicies) -> Qos:
    """With a deadline besides, which no advice may take away."""
    return Qos(**pair.policies, deadline_ns=S)


def rows() -> Iterator[tuple[MatchedPolicies, bool, EndpointKind, MatchedPolicies]]:
    """Asked, whether just this, kind, seen."""
    yield from itertools.product(PAIRS, (True, False), KINDS, PAIRS)


@pytest.mark.parametrize(("asked", "exact", "kind", "seen"), [*rows()], ids=str)
def test_who_follows_passes(
    asked: MatchedPolicies, exact: bool, kind: EndpointKind, seen: MatchedPolicies
) -> None:
    """By the words alone, by the whole profile, and by the shorter word where there is one."""
    look = judged(asked, exact, kind)
    fault = fault_of(look, view(kind, seen_as(seen)))
    if fault is None:
        assert seen == asked if exact else not qos_conflicts(kind, seen, asked)
        return
    assert isinstance(fault, OtherQos)
    mended = replace(seen_as(seen), **fault.advised)
    assert mended.deadline_ns == S
    for better in (mended, seen_as(policies_of(run(fault.profile)))):
        assert fault_of(look, view(kind, better)) is None
    if fault.shorter:
        assert policies_of(run(fault.shorter)) == asked
        assert fault.shorter in fault.mend
    assert fault.profile in fault.mend
    assert_it_is_of_this_card(fault, kind)


def assert_it_is_of_this_card(fault: Fault, kind: EndpointKind) -> None:
    """Topic, kind and what is asked stand in the words; no other topic, no thing of another lab."""
    said = " ".join((fault.expected, fault.measured, fault.why, fault.hint, fault.mend))
    assert TOPIC in fault.expected
    assert f"{CALLS[kind]}(...) for {TOPIC}" in fault.mend
    assert not any(call in said for other, call in CALLS.items() if other != kind)
    assert OTHER not in said
    assert not any(word in said.lower() for word in ("picture", "camera", "e_stop"))


@pytest.mark.parametrize("asked", PAIRS, ids=str)
def test_the_kind_stands_in_what_is_expected(asked: MatchedPolicies) -> None:
    """Also where one node publishes and subscribes on one topic."""
    for exact, kind, seen in itertools.product((True, False), KINDS, PAIRS):
        if fault := fault_of(judged(asked, exact, kind), view(kind, seen_as(seen))):
            assert fault.expected.startswith(f"a {kind} on {TOPIC}")


def test_a_stop_button_is_not_advised_to_lose_presses() -> None:
    """The case that was: a guard that hears /e_stop best effort, and commands that are kept."""
    button = judged(MatchedPolicies("reliable", "transient_local"), True, "subscription")
    fault = fault_of(button, view("subscription", Qos(reliability="best_effort")))
    assert isinstance(fault, OtherQos)
    assert fault.profile == (
        "QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE,"
        " durability=DurabilityPolicy.TRANSIENT_LOCAL)"
    )
    assert "sensor_data" not in fault.mend
    commands = judged(MatchedPolicies("best_effort", "volatile"), False, "subscription")
    kept = fault_of(
        commands, view("subscription", Qos(reliability="best_effort", durability="transient_local"))
    )
    assert isinstance(kept, OtherQos)
    assert "TRANSIENT_LOCAL" not in kept.mend
    assert kept.advised["durability"] == "volatile"


def test_no_other_fault_advises_a_profile() -> None:
    """Words that stand ready for one lab are wrong for the next one: faults take the card's."""
    ours = {Path(inspect.getfile(each)) for each in (OtherQos, of_times, python_words)}
    files = {
        *ENGINE.rglob("faults.py"),
        *ENGINE.rglob("faults/*.py"),
        *GRADERS.glob("*.py"),
        *GRADERS.glob("*/faults.py"),
    }
    assert ours < files
    wordy = re.compile(r"QoSProfile|qos_profile|\b[A-Z]\w+Policy\b")
    assert [file.name for file in files - ours if wordy.search(file.read_text("utf-8"))] == []


def test_no_card_asks_what_is_not_in_the_table() -> None:
    """Each topic of each lab and drill is one of its rows."""
    nodes = [node for lab in all_labs() for node in lab.card.nodes]
    nodes += [node for drill in all_drills() for node in drill.card.nodes]
    topics = [topic for node in nodes for topic in (*node.publishes, *node.subscribes)]
    assert {MatchedPolicies(each.qos.reliability, each.qos.durability) for each in topics} <= set(
        PAIRS
    )
    assert set(QosContract.model_fields) == {"reliability", "durability", "exact"}


# --- deadline, lifespan, liveliness and its lease ----------------------------------------------

NS_OF = {"deadline_s": "deadline_ns", "lease_s": "lease_ns", "lifespan_s": "lifespan_ns"}
ASKED_S = (0.2, 2.5, 123456.75)
FOUND_NS = (None, S)


def cards_of_times() -> Iterator[tuple[EndpointKind, TimesContract]]:
    """Each word alone, and all at once; both ways to give signs of life."""
    for asked_s, liveliness in itertools.product(ASKED_S, get_args(Liveliness)):
        for kind, card in (("publisher", OfferContract), ("subscription", AskContract)):
            words = [word for word in NS_OF if word in card.model_fields]
            for some in ([word] for word in words):
                yield kind, _card(card, some, asked_s, liveliness)  # type: ignore[misc]
            yield kind, _card(card, words, asked_s, liveliness)  # type: ignore[misc]


def _card(
    card: type[TimesContract], words: list[str], asked_s: float, liveliness: str
) -> TimesContract:
    said = dict.fromkeys(words, asked_s)
    return card.model_validate({"topic": TOPIC, "liveliness": liveliness, **said})


@pytest.mark.parametrize(("kind", "card"), [*cards_of_times()], ids=str)
@pytest.mark.parametrize("found_ns", FOUND_NS)
@pytest.mark.parametrize("liveliness", get_args(Liveliness))
def test_who_follows_each_word_passes(
    kind: EndpointKind, card: TimesContract, found_ns: int | None, liveliness: str
) -> None:
    """Each advice mends one word, so after so many of them nothing is left."""
    demand = times.offer(card) if isinstance(card, OfferContract) else times.ask_for(card)  # type: ignore[arg-type]
    qos = Qos(liveliness=liveliness, **dict.fromkeys(NS_OF.values(), found_ns))
    for _ in range(len(NS_OF) + 1):
        fault = fault_of(demand, view(kind, qos))
        if fault is None:
            return
        assert isinstance(fault, of_times.OtherPromise)
        assert fault.advice in fault.mend
        assert_it_is_of_this_card(fault, kind)
        qos = followed(fault.advice, qos)
    assert fault_of(demand, view(kind, qos)) is None


def followed(advice: str, qos: Qos) -> Qos:
    """The endpoint after this one word was given to its profile, as rclpy understands it."""
    profile = run(f"QoSProfile(depth=1, {advice})")
    name = advice.partition("=")[0]
    if name == "liveliness":
        return replace(qos, liveliness=profile.liveliness.name.lower())
    field = "lease_ns" if name == "liveliness_lease_duration" else f"{name}_ns"
    return replace(qos, **{field: getattr(profile, name).nanoseconds})


# --- how many are kept -------------------------------------------------------------------------


def joined(heard: int, said: int) -> QosSeen:
    """Somebody who came late."""
    one = JoinSeen(after="a call", wanted=True, said=said, heard=[True] * heard)
    return QosSeen(joins=[one])


@pytest.mark.parametrize("keeps", [1, 3, 10])
@pytest.mark.parametrize("heard", [0, 1, 2, 12])
@pytest.mark.parametrize("said", [2, 20])
def test_who_keeps_as_many_as_advised_passes(keeps: int, heard: int, said: int) -> None:
    """A publisher keeps as many as its depth, of those that it said."""
    demand = times.keep_for_late_joiners(OfferContract(topic=TOPIC, keeps=keeps))
    fault = fault_of(demand, view("publisher", Qos(), joined(heard, said)))
    if fault is None:
        assert heard == min(keeps, said)
        return
    assert isinstance(fault, of_times.NothingForLateJoiners)
    profile = run(fault.profile)
    assert policies_of(profile).durability == "transient_local"
    kept = min(profile.depth, said)
    assert fault_of(demand, view("publisher", Qos(), joined(kept, said))) is None
    assert fault.profile in fault.mend
    assert_it_is_of_this_card(fault, "publisher")
