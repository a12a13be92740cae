"""A talker that stops while its node runs on, and one that ends, seen in real time."""

from __future__ import annotations

import pytest

from judge_messages import messages
from ros2_on_pip.rates import NS_PER_S
from roslings.capabilities.topics.demands import have_rate
from roslings.capabilities.topics.faults.rhythm import FallsSilent
from roslings.capabilities.topics.reasons import EndedInSilence
from roslings.course import RateContract, TopicContract
from roslings.evidence import Endpoint, ExperimentSeen, GraphSeen, ProcessSeen, Qos, TopicSeen
from roslings.judge.faults import Inconclusive
from roslings.judge.views import ExperimentView

CHATTER = TopicContract(
    topic="/chatter", type="std_msgs/msg/String", rate=RateContract(hz=2.0, within=0.05)
)


def watched(silent_s: float, *, stall_s: float = 0.0, ended: bool = False) -> ExperimentView:
    """Twenty messages, and then so many seconds until the watch ended."""
    said = messages([500.0 * n for n in range(20)])
    until_ns = said[-1].arrival_ns + round(silent_s * NS_PER_S)
    process = ProcessSeen(executable="talker", started_ns=0)
    process.ended_ns = until_ns - 1 if ended else None
    qos = Qos(reliability="reliable", durability="volatile")
    talker = Endpoint(
        kind="publisher", node="/talker", topic=CHATTER.topic, type=CHATTER.type, qos=qos, gid=""
    )
    seen = ExperimentSeen(
        name="alone",
        clock="wall",
        graph=GraphSeen(nodes=["/talker"], endpoints=[talker]),
        topics={"/chatter": TopicSeen(name="/chatter", type=CHATTER.type, messages=said)},
        processes={"talker": process},
    )
    seen.rate_until_ns, seen.stall_s = until_ns, stall_s
    return ExperimentView(seen)


def test_who_falls_silent_is_told_so() -> None:
    """Its rate was right until then."""
    with pytest.raises(FallsSilent) as told:
        watched(5.0).topic(CHATTER).must(have_rate(CHATTER))
    assert "20 messages, and then none for 5.0 s" in str(told.value)


@pytest.mark.parametrize(
    "view", [watched(0.7), watched(5.0, ended=True)], ids=["speaks on", "ended"]
)
def test_other_silence_is_no_fault(view: ExperimentView) -> None:
    """The next message is not due yet; or the node's end is told elsewhere."""
    view.topic(CHATTER).must(have_rate(CHATTER))


def test_who_is_late_at_the_end_is_watched_again() -> None:
    """Two periods and a half may be the first of a silence; nobody has 100 for them."""
    with pytest.raises(EndedInSilence) as told:
        watched(1.3).topic(CHATTER).must(have_rate(CHATTER))
    assert "due each 0.5 s, and the last one came 1.3 s before the end" in str(told.value)


def test_a_computer_that_stood_still_tells_nothing() -> None:
    """It may have kept the messages back."""
    with pytest.raises(Inconclusive):
        watched(9.0, stall_s=2.0).topic(CHATTER).must(have_rate(CHATTER))
