"""What is held against the times that a node offers or asks for, and what against what it keeps."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from roslings.capabilities.qos import demands, faults
from roslings.capabilities.qos.contract import AskContract, OfferContract, rows
from roslings.capabilities.qos.record import JoinSeen, QosSeen
from roslings.capabilities.qos.report import sections
from roslings.course import NodeContract, TopicContract
from roslings.evidence import (
    Endpoint,
    Evidence,
    ExperimentSeen,
    GraphSeen,
    MachineSeen,
    PackageSeen,
    Qos,
)
from roslings.judge import ExperimentView, Inconclusive
from roslings.judge.faults import Fault, NothingToJudge, NoTopic

S = 10**9
MOTORS = TopicContract(topic="/motors", type="geometry_msgs/msg/Twist")
DOOR = TopicContract(topic="/door", type="std_msgs/msg/Bool")


def view(part: QosSeen | None = None, **fields: Any) -> ExperimentView:
    """An experiment in which this was seen."""
    parts = {"qos": part} if part else {}
    return ExperimentView(ExperimentSeen(name="x", clock="wall", parts=parts, **fields))


def found(demand: Callable[[ExperimentView], None], seen: ExperimentView) -> type[Exception] | None:
    """What a demand raises: which fault, or that it gives no answer."""
    try:
        demand(seen)
    except Fault as problem:
        return type(problem)
    except (Inconclusive, NothingToJudge) as reason:
        return Inconclusive if isinstance(reason, Inconclusive) else NothingToJudge
    return None


# --- what is offered and asked for -------------------------------------------------------------


def end(kind: str = "publisher", **qos: Any) -> GraphSeen:
    """A graph with one endpoint."""
    one = Endpoint(
        kind=kind, node="/porter", topic="/motors", type=MOTORS.type, qos=Qos(**qos), gid="1"
    )  # type: ignore[arg-type]
    return GraphSeen(nodes=["/porter"], endpoints=[one], services={})


@pytest.mark.parametrize(
    ("qos", "fault"),
    [
        ({"deadline_ns": S // 5, "lifespan_ns": S // 2, "lease_ns": S}, None),
        ({"deadline_ns": S, "lifespan_ns": S // 2, "lease_ns": S}, faults.OtherTime),
        ({"deadline_ns": S // 5, "lease_ns": S}, faults.OtherTime),
        ({"deadline_ns": S // 5, "lifespan_ns": S // 2}, faults.OtherTime),
        (
            {
                "deadline_ns": S // 5,
                "lifespan_ns": S // 2,
                "lease_ns": S,
                "liveliness": "manual_by_topic",
            },
            faults.OtherLiveliness,
        ),
    ],
)
def test_a_publisher_offers_the_times_of_the_card(qos: Any, fault: type[Exception] | None) -> None:
    """Each of them, and the way to give signs of life."""
    offered = OfferContract(topic="/motors", deadline_s=0.2, lifespan_s=0.5, lease_s=1.0)
    assert found(demands.offer(offered), view(graph=end(**qos))) is fault


def test_a_subscription_is_told_what_it_asks_for() -> None:
    """In words, and as the profile names it."""
    asked = AskContract(topic="/motors", lease_s=2.0)
    with pytest.raises(faults.OtherTime) as fault:
        demands.ask_for(asked)(view(graph=end("subscription")))
    assert fault.value.expected == "on /motors the node asks for a lease of 2 s"
    assert fault.value.measured == "it asks for none"
    assert "create_subscription(...) for /motors" in fault.value.mend
    assert "liveliness_lease_duration=Duration(seconds=2.0)" in fault.value.mend


def test_a_topic_that_is_not_there_offers_nothing() -> None:
    """Another name is no other time."""
    asked = AskContract(topic="/engine", deadline_s=2.0)
    assert found(demands.ask_for(asked), view(graph=end("subscription"))) is NoTopic


# --- a latched topic ---------------------------------------------------------------------------


def join(*heard: bool, said: int = 3, wanted: bool = True) -> QosSeen:
    """Somebody who came late."""
    return QosSeen(joins=[JoinSeen(after="a call", wanted=wanted, said=said, heard=list(heard))])


@pytest.mark.parametrize(
    ("seen", "fault"),
    [
        (join(True), None),
        (join(), faults.NothingForLateJoiners),
        (join(False, True), faults.OtherCountForLateJoiners),
        (QosSeen(), NothingToJudge),
    ],
)
def test_a_late_joiner_gets_the_last_message(seen: QosSeen, fault: type[Exception] | None) -> None:
    """That one, and no other."""
    assert (
        found(demands.keep_for_late_joiners(OfferContract(topic="/door", keeps=1)), view(seen))
        is fault
    )


def test_more_are_kept_where_the_card_says_so_as_far_as_more_were_said() -> None:
    """Of one message nobody can keep two."""
    keeps = demands.keep_for_late_joiners(OfferContract(topic="/door", keeps=2))
    assert found(keeps, view(join(True, said=1))) is None
    assert found(keeps, view(join(False, True))) is None
    assert found(keeps, view(join(True))) is faults.OtherCountForLateJoiners


def test_the_last_message_says_what_holds() -> None:
    """An old one is worse than none."""
    demand = demands.tell_late_joiners_the_truth(DOOR)
    assert found(demand, view(join(True))) is None
    assert found(demand, view(join(False))) is faults.OldForLateJoiners


# --- words and pages ---------------------------------------------------------------------------


def test_the_task_tells_all_words() -> None:
    """Each time, and what is kept."""
    node = NodeContract(
        node="/porter",
        executable="porter",
        offers=(OfferContract(topic="/door", keeps=1, lease_s=1.0, lifespan_s=3.0),),
        asks=(AskContract(topic="/motors", deadline_s=0.4),),
    )
    told = [" ".join(row) for row in rows(node)]
    assert told == [
        "offers on `/door`",
        "liveliness automatic, with a lease of 1 s",
        "lifespan 3 s",
        "a late joiner gets the last message",
        "asks on `/motors`",
        "deadline 0.4 s",
    ]


def test_the_page_shows_who_came_late() -> None:
    """After what, and what it got."""
    evidence = Evidence(
        lab="x",
        seed=1,
        machine=MachineSeen(
            roslings="0", ros_distro="jazzy", rmw="", python="3", platform="x", isolation="domain"
        ),
        package=PackageSeen(name="x", folder="x", build_type="ament_python"),
        experiments={"x": view(join(True)).seen},
    )
    page = "".join(map(str, sections(evidence)))
    assert "a call" in page and "true" in page
