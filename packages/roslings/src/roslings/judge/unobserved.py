"""What must hold where nothing but the student's own nodes ran."""

from __future__ import annotations

from roslings.course import NodeContract, TopicContract
from roslings.course.files import written
from roslings.judge.demands import (
    be_there,
    carry_its_type,
    match_qos,
    repeat,
    require_believable,
)
from roslings.judge.faults import Fault, NothingToJudge
from roslings.judge.faults.unobserved import SpeaksOnlyWhenObserved, WritesWhatWasNotSent
from roslings.judge.views import Demand, ExperimentView
from roslings.seen.log_rates import hz_of, is_often, written_hz


def speak_unobserved(
    talking: ExperimentView,
    hearing: ExperimentView,
    nodes: tuple[NodeContract, NodeContract],
    topics: tuple[TopicContract, TopicContract],
) -> Demand[ExperimentView]:
    """The talker is heard as often when nobody but the listener is there.

    `nodes` are talker and listener, `topics` what each of them uses; `talking` and `hearing` show
    them alone, observed. What keeps the two apart there costs its own points, and none here.
    """
    _, listener = nodes
    rate = written(topics[0].rate, topics[0].topic)

    def demand(view: ExperimentView) -> None:
        if not view.seen.processes or not _understand(talking, hearing, nodes, topics):
            return
        require_believable(view.seen)
        hz = written_hz(view.process(listener).seen.lines, listener)
        if not is_often(hz, rate):
            raise SpeaksOnlyWhenObserved(topics[0].topic, rate.hz, hz)
        for topic, sent_ns in view.seen.sent_ns.items():
            if not is_often(hz_of(sent_ns), rate):
                raise WritesWhatWasNotSent(topic, rate.hz, hz_of(sent_ns))

    return demand


def _understand(
    talking: ExperimentView,
    hearing: ExperimentView,
    nodes: tuple[NodeContract, NodeContract],
    topics: tuple[TopicContract, TopicContract],
) -> bool:
    """Observed, the one can be heard and the other one hears."""
    talker, listener = nodes
    said, heard = topics
    try:
        talking.publisher(talker, said).must(be_there, carry_its_type, match_qos)
        hearing.subscription(listener, heard).must(be_there, carry_its_type, match_qos)
        hearing.process(listener).must(repeat(listener, hearing.seen.spoken))
    except (Fault, NothingToJudge):
        return False
    return True
