"""Demands on quality of service: what is offered and asked for, and what late joiners get."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ros2_on_pip.rates import NS_PER_S
from roslings.capabilities.qos import faults
from roslings.capabilities.qos.contract import AskContract, OfferContract, TimesContract
from roslings.capabilities.qos.reasons import NobodyCameLate
from roslings.capabilities.qos.record import JoinSeen, QosSeen
from roslings.course import TopicContract
from roslings.course.contract import as_typed
from roslings.course.files import written
from roslings.judge.demands import require_steady
from roslings.judge.faults import EndpointKind, NoTopic
from roslings.judge.faults.moments import one_after_the_other
from roslings.judge.faults.sentences import Text
from roslings.judge.views import Demand, ExperimentView

SAME_NS = 1_000_000


# --- what is offered and asked for -------------------------------------------------------------


def offer(contract: OfferContract) -> Demand[ExperimentView]:
    """The node's publisher offers these times."""
    return _times("publisher", contract, {"lifespan": contract.lifespan_s})


def ask_for(contract: AskContract) -> Demand[ExperimentView]:
    """The node's subscription asks for these times."""
    return _times("subscription", contract, {})


def _times(
    kind: EndpointKind,
    contract: TimesContract,
    more: Mapping[str, float | None],
) -> Demand[ExperimentView]:
    wanted = {"deadline": contract.deadline_s, "lease": contract.lease_s, **more}

    def demand(experiment: ExperimentView) -> None:
        ends = [
            end
            for end in experiment.seen.graph.endpoints
            if end.kind == kind and end.topic == contract.topic
        ]
        if not ends:
            raise NoTopic(contract.topic, kind)
        qos = ends[0].qos
        if contract.lease_s and qos.liveliness != contract.liveliness:
            raise faults.OtherLiveliness(contract.topic, kind, contract.liveliness, qos.liveliness)
        found = {"deadline": qos.deadline_ns, "lease": qos.lease_ns, "lifespan": qos.lifespan_ns}
        for word, limit_s in wanted.items():
            if limit_s and not _is_same(found[word], limit_s):
                raise faults.OtherTime(contract.topic, kind, word, limit_s, _in_s(found[word]))

    return demand


def _is_same(found_ns: int | None, wanted_s: float) -> bool:
    return found_ns is not None and abs(found_ns - wanted_s * NS_PER_S) < SAME_NS


def _in_s(found_ns: int | None) -> float | None:
    return None if found_ns is None else found_ns / NS_PER_S


# --- a latched topic ---------------------------------------------------------------------------


def keep_for_late_joiners(contract: OfferContract) -> Demand[ExperimentView]:
    """Who comes late gets the last messages, as many as the card says, and no others."""
    keeps = written(contract.keeps, contract.topic)

    def demand(experiment: ExperimentView) -> None:
        joins = experiment.seen.part(QosSeen).joins
        if not joins:
            raise NobodyCameLate("nobody", contract.topic)
        for join in joins:
            _judge_join(experiment, contract.topic, join, keeps)

    return demand


def _judge_join(experiment: ExperimentView, topic: str, join: JoinSeen, keeps: int) -> None:
    if not join.heard:
        require_steady(experiment.seen.stall_s)
        raise faults.NothingForLateJoiners(topic, join.after, keeps)
    if len(join.heard) != min(keeps, join.said):
        heard = values_told(join.heard)
        wanted = min(keeps, join.said)
        raise faults.OtherCountForLateJoiners(topic, join.after, keeps, wanted, heard)


def tell_late_joiners_the_truth(topic: TopicContract) -> Demand[ExperimentView]:
    """The last message that a late joiner gets says what holds then."""

    def demand(experiment: ExperimentView) -> None:
        joins = [join for join in experiment.seen.part(QosSeen).joins if join.heard]
        if not joins:
            raise NobodyCameLate("nothing", topic.topic)
        for join in joins:
            if join.heard[-1] != join.wanted:
                words = (join.after, as_typed(join.wanted), as_typed(join.heard[-1]))
                raise faults.OldForLateJoiners(topic.topic, *words)

    return demand


def values_told(values: Iterable[object]) -> Text:
    """One after the other."""
    return one_after_the_other(map(as_typed, values))
