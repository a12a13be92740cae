"""Demands on how a node takes its parameters and its names."""

from __future__ import annotations

import difflib
from collections.abc import Sequence

from ros2_on_pip.rates import Rate
from roslings.capabilities.parameters.contract import ParameterContract, ParameterWords
from roslings.capabilities.parameters.faults import (
    NameStays,
    NoParameter,
    ParameterIgnored,
    ParameterMisread,
    TopicStays,
    WrongDefault,
    WrongParameterType,
)
from roslings.capabilities.parameters.reasons import ParametersUnknown
from roslings.capabilities.parameters.record import (
    GIVEN_BY_ROS,
    ParameterDeclared,
    ParametersSeen,
)
from roslings.capabilities.topics.demands import have_rate
from roslings.course import NodeContract, RateContract, TopicContract
from roslings.course.files import written
from roslings.judge.demands import require_believable, require_steady
from roslings.judge.values import same
from roslings.judge.views import Demand, ExperimentView, TopicView
from roslings.seen.matching import nearest_endpoint, own_endpoints


def has_parameter(node: NodeContract, parameter: ParameterContract) -> Demand[ExperimentView]:
    """The node lists the parameter among its own."""

    def demand(experiment: ExperimentView) -> None:
        name = experiment.node(node).near.found
        listed = experiment.seen.part(ParametersSeen).names.get(name)
        if not listed:
            raise ParametersUnknown("no_names", name)
        own = tuple(each for each in listed if each not in GIVEN_BY_ROS and "." not in each)
        if parameter.name not in own:
            near = difflib.get_close_matches(parameter.name, own, n=1)
            raise NoParameter(name, parameter.name, own, near[0] if near else None)

    return demand


def declare_its_parameters(node: NodeContract, *given: str) -> Demand[ExperimentView]:
    """Each parameter of the card is there, of its type and with its default.

    `given` are those that the node was started with, besides what its process says: their
    defaults cannot be seen.
    """

    def demand(experiment: ExperimentView) -> None:
        unseen = {*given, *_given(experiment, node)}
        for parameter in node.of(ParameterWords).parameters:
            experiment.must(has_parameter(node, parameter))
            found = _declared(experiment, node, parameter)
            if found.type != parameter.type:
                raise WrongParameterType(found.node, found.name, parameter.type, found.type)
            if parameter.name not in unseen and not same(found.value, parameter.default):
                wanted, is_ = repr(parameter.default), repr(found.value)
                raise WrongDefault(found.node, found.name, wanted, is_)

    return demand


def _given(experiment: ExperimentView, node: NodeContract) -> Sequence[str]:
    process = experiment.seen.processes.get(node.executable)
    return process.given if process else ()


def _declared(
    experiment: ExperimentView, node: NodeContract, parameter: ParameterContract
) -> ParameterDeclared:
    name = experiment.node(node).near.found
    for each in experiment.seen.part(ParametersSeen).declared:
        if (each.node, each.name) == (name, parameter.name):
            return each
    raise ParametersUnknown("no_values", name)


def follow_its_parameter(
    parameter: ParameterContract, usual: TopicContract, asked: TopicContract
) -> Demand[TopicView]:
    """With the parameter set, the topic has the rate `asked`, and no longer its usual one."""
    wanted, before = written(asked.rate, asked.topic), written(usual.rate, usual.topic)
    asked_for = (parameter.name, f"{parameter.tried}", wanted.hz)

    def demand(topic: TopicView) -> None:
        require_believable(topic.experiment)
        rate = topic.rate
        if rate is None or not (_within(rate, wanted) or _within(rate, before)):
            require_steady(topic.experiment.stall_s)
            raise ParameterMisread(*asked_for, *_heard(topic), parameter.about)
        if not _within(rate, wanted):
            raise ParameterIgnored(*asked_for, *_heard(topic))
        topic.must(have_rate(asked))

    return demand


def _heard(topic: TopicView) -> tuple[float | None, int, float]:
    """The rate in Hz, where there is one; how many messages came, and in how many seconds."""
    hz = topic.rate.hz if topic.rate else None
    return hz, len(topic.messages), topic.experiment.watching_s


def _within(rate: Rate, limit: RateContract) -> bool:
    return limit.low_hz <= rate.hz <= limit.high_hz


def take_names(names: Sequence[str]) -> Demand[ExperimentView]:
    """Each node has the full name that it was started with."""

    def demand(experiment: ExperimentView) -> None:
        there = tuple(experiment.seen.graph.nodes)
        for name in names:
            if name not in there:
                raise NameStays(name, there)

    return demand


def carry_topic_along(
    names: Sequence[str], topic: TopicContract, alone: ExperimentView
) -> Demand[ExperimentView]:
    """Under each name, the topic lies in that name's namespace; `alone` tells its plain name."""

    def demand(experiment: ExperimentView) -> None:
        plain = nearest_endpoint(alone.seen.graph, "publisher", topic.topic, topic.type)
        if plain is None:
            raise ParametersUnknown("no_topic")
        for name in names:
            wanted = carried(plain.topic, plain.node, name)
            found = _topics_of(experiment, name)
            if wanted not in found:
                raise TopicStays(name, wanted, found)

    return demand


def carried(topic: str, node: str, new_node: str) -> str:
    """The topic of a node that gets another name, where the code gives a relative name.

    >>> carried("/status", "/rover", "/left/first")
    '/left/status'
    >>> carried("/rover/status", "/rover", "/left/first")
    '/left/first/status'
    """
    space, new_space = (name.rpartition("/")[0] for name in (node, new_node))
    for old, new in ((node, new_node), (space, new_space)):
        if topic.startswith(f"{old}/"):
            return new + topic[len(old) :]
    return topic


def _topics_of(experiment: ExperimentView, node: str) -> tuple[str, ...]:
    ends = own_endpoints(experiment.seen.graph)
    return tuple(sorted({e.topic for e in ends if e.kind == "publisher" and e.node == node}))
