"""What is demanded of a drill's program, in the order in which it is mended: all from the card.

The demands are those of the labs; where a program makes no node, those of `terminal`. The first one
that is not met is the verdict.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import starmap
from typing import Any

from roslings.capabilities.actions.record import ActionsSeen
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.parameters.demands import declare_its_parameters
from roslings.capabilities.services.contract import ServiceWords
from roslings.capabilities.services.demands import (
    answer_each,
    ask,
    end_by_itself,
    require_no_crash,
    serve,
    serve_their_types,
    tell_the_answer,
)
from roslings.capabilities.services.record import ServicesSeen
from roslings.capabilities.topics.act import nested
from roslings.capabilities.topics.demands import (
    count_up,
    have_rate,
    say_its_text,
    say_something,
)
from roslings.capabilities.topics.relay import RelayedValue, hold_its_fields, show
from roslings.course import NodeContract, TopicContract
from roslings.course.contract import Plain
from roslings.evidence import ExperimentSeen
from roslings.judge import (
    ExperimentView,
    be_named,
    be_the_only_one,
    be_there,
    carry_its_type,
    come_up,
    end_within,
    exit_cleanly,
    log_each,
    match_qos,
    repeat,
    stay_up,
)
from roslings.judge.demands import most_similar, require_its_time, require_steady
from roslings.judge.faults import NotLogged
from roslings.judge.faults.moments import AfterTold, Awaited
from roslings.judge.values import Fields, shown
from roslings.judge.views import Demand, EndpointView, NodeView, ProcessView, TopicView
from roslings.seen.matching import nearest_endpoint
from roslings_learn.drills import faults
from roslings_learn.drills.answers import compare
from roslings_learn.drills.card import PROGRAM, DrillCard, Tell
from roslings_learn.drills.faults import AT_ITS_END
from roslings_learn.drills.goals import demands_of
from roslings_learn.drills.reasons import NothingShown
from roslings_learn.drills.terminal import (
    Look,
    ends_by_itself,
    script_comes_up,
    steps_of_output,
)

ENDS_WITHIN_S = 2.0
BY_GRAPH = ("runs", "stays", "spins", "name", "topic", "qos")
"""Steps that look at what is there, not at what is said: no clock can bend them."""
BY_END = ("ends", "clean_exit")
"""Steps that look at how it ends after Ctrl-C."""


@dataclass(frozen=True)
class Step:
    """One demand: its short name, the sentence for it, and what looks at the evidence."""

    name: str
    title: str
    demand: Look

    @property
    def by_graph(self) -> bool:
        """Whether it is judged before all that is said."""
        return self.name in BY_GRAPH


def steps_of(card: DrillCard, said: Any = None) -> Iterator[Step]:
    """All that is demanded, in order; `said` is what the student has foretold."""
    yield from _of_processes(card) if card.nodes else ()
    yield from starmap(Step, steps_of_output(card))
    for node in card.nodes:
        yield from _of_topics(node)
    for node in card.nodes:
        yield from _of_what_it_hears(node, card)
        yield from _of_services(node)
    yield from _of_what_it_is_told(card)
    yield from starmap(Step, demands_of(card))
    if card.answer:
        title = "What you foretold is what the run shows."
        yield Step("foretold", title, lambda view: compare(said, card, view))
    yield from _of_ends(card)


# --- what a demand is made of ------------------------------------------------------------------


def _of_all(*demands: Demand[ExperimentView]) -> Look:
    return lambda view: view.must(*demands)


def _of_process(node: NodeContract, *demands: Demand[ProcessView]) -> Look:
    return lambda view: view.process(node).must(*demands)


def _of_node(node: NodeContract, *demands: Demand[NodeView]) -> Look:
    return lambda view: view.node(node).must(*demands)


def _of_topic(topic: TopicContract, *demands: Demand[TopicView]) -> Look:
    return lambda view: view.topic(topic).must(*demands)


def _of_publisher(node: NodeContract, topic: TopicContract, *demands: Demand[EndpointView]) -> Look:
    return lambda view: view.publisher(node, topic).must(*demands)


def _of_subscription(
    node: NodeContract, topic: TopicContract, *demands: Demand[EndpointView]
) -> Look:
    return lambda view: view.subscription(node, topic).must(*demands)


# --- processes, the graph ----------------------------------------------------------------------


def _of_processes(card: DrillCard) -> Iterator[Step]:
    if card.exits is None:
        yield from _of_what_stays(card)
    else:
        title = "The program does its task without an error."
        yield Step("runs", title, _of_process(card.nodes[0], _does_its_task))
    for node in card.nodes:
        yield from _of_endpoints(node)
        if node.of(ParameterWords).parameters:
            title = "It has the parameters that the card names."
            yield Step("parameter", title, _of_all(declare_its_parameters(node)))


def _of_what_stays(card: DrillCard) -> Iterator[Step]:
    first = card.nodes[0]
    look = script_comes_up if card.program == "bash" else come_up
    yield Step("runs", "The program starts and makes a node.", _unless_asked(first, look))
    yield Step("stays", "It runs until Ctrl-C.", _unless_asked(first, stay_up))
    yield Step("spins", "It runs its callbacks.", _spins)
    for node in card.nodes:
        yield Step("name", f"The node is called {node.node}.", _of_node(node, be_named))


def _does_its_task(process: ProcessView) -> None:
    require_no_crash(process, "task")


def _unless_asked(node: NodeContract, look: Demand[ProcessView]) -> Look:
    """Who ended when a service of it was called came up before: that is told by the answers."""

    def demand(view: ExperimentView) -> None:
        process = view.process(node)
        if not (view.seen.part(ServicesSeen).calls and process.shown):
            process.must(look)

    return demand


def _spins(view: ExperimentView) -> None:
    for name in view.seen.stuck:
        require_steady(view.seen.stall_s)
        raise faults.NeverSpins(name)


def _of_endpoints(node: NodeContract) -> Iterator[Step]:
    for topic in node.publishes:
        title = f"It publishes {topic.type} on {topic.topic}."
        there = _of_publisher(node, topic, be_there, carry_its_type, be_the_only_one)
        yield Step("topic", title, there)
        title = f"Who subscribes to {topic.topic} can hear it (QoS)."
        yield Step("qos", title, _of_publisher(node, topic, match_qos))
    for topic in node.subscribes:
        title = f"It subscribes to {topic.topic}, type {topic.type}."
        yield Step("topic", title, _of_subscription(node, topic, be_there, carry_its_type))
        title = f"It can hear who publishes on {topic.topic} (QoS)."
        yield Step("qos", title, _of_subscription(node, topic, match_qos))


# --- what it says and answers ------------------------------------------------------------------


def _of_topics(node: NodeContract) -> Iterator[Step]:
    """What the messages of the node say, and how often they come."""
    for topic in node.publishes:
        if topic.rate:
            title = f"{topic.topic} carries {topic.rate.hz:g} messages a second."
            yield Step("rate", title, _of_topic(topic, have_rate(topic)))
        if topic.text or topic.fields:
            title = f"The messages on {topic.topic} say what the card says."
            yield Step("message", title, _of_topic(topic, *_sayings(topic)))
        if topic.text and "{n}" in topic.text:
            title = "The number goes up by one from message to message."
            yield Step("counting", title, _of_topic(topic, count_up))
        if topic.text and node.log and not node.subscribes:
            title = "It writes each message that it publishes, once."
            yield Step("logs", title, _logs(node, topic))


def _sayings(topic: TopicContract) -> Iterator[Demand[TopicView]]:
    yield say_something
    if topic.text:
        yield say_its_text
    if topic.fields:
        yield hold_its_fields


def _logs(node: NodeContract, topic: TopicContract) -> Look:
    return lambda view: view.process(node).must(log_each(node, view.topic(topic).texts))


def _of_what_it_hears(node: NodeContract, card: DrillCard) -> Iterator[Step]:
    if node.subscribes and node.log and card.says:
        title = "It writes every sentence that is said to it, once."
        yield Step("hears", title, lambda view: _hears(view, node))


def _hears(view: ExperimentView, node: NodeContract) -> None:
    graph = view.seen.graph
    ends = [nearest_endpoint(graph, "subscription", t.topic, t.type) for t in node.subscribes]
    names = {each.topic for each in ends if each}
    spoken = [each for each in view.seen.spoken if each.topic in names]
    view.process(node).must(repeat(node, spoken))


def _of_services(node: NodeContract) -> Iterator[Step]:
    services = node.of(ServiceWords)
    for service in services.serves:
        title = f"It serves {service.service}, type {service.type}."
        yield Step("service", title, _of_all(serve(service), serve_their_types(service)))
        title = f"{service.service} gives the answers of the card."
        yield Step("answers", title, _of_all(answer_each(node, service)))
    for service in services.calls:
        title = f"It calls {service.service} with the card's request."
        yield Step("asks", title, _of_all(ask(node, service)))
        if node.log:
            yield Step("tells", "It writes what the answer says.", _of_all(tell_the_answer(node)))


def _of_ends(card: DrillCard) -> Iterator[Step]:
    if card.exits is not None:
        title = f"It ends by itself, with exit code {card.exits}."
        yield Step("exits", title, _ends_by_itself(card, card.exits))
    if card.ends_well:
        ends, node = end_within(ENDS_WITHIN_S), card.nodes[0]
        yield Step("ends", "Ctrl-C ends it at once.", _of_process(node, ends))
        title = "After Ctrl-C it ends without an error."
        yield Step("clean_exit", title, _of_process(node, exit_cleanly))


def _ends_by_itself(card: DrillCard, exit_code: int) -> Look:
    if not card.nodes:
        return ends_by_itself(exit_code)
    return _of_all(end_by_itself(card.nodes[0], exit_code, AT_ITS_END, _was_answered))


def _was_answered(seen: ExperimentSeen) -> bool:
    return bool(seen.part(ServicesSeen).served or seen.part(ActionsSeen).orders)


# --- what comes of what it is told -------------------------------------------------------------


def _of_what_it_is_told(card: DrillCard) -> Iterator[Step]:
    for number, tell in enumerate(card.tells):
        title = f"It makes the right thing of {tell.topic}."
        if tell.log is not None:
            yield Step("answers", title, _writes(tell, tell.log))
        for field in tell.publishes.fields if tell.publishes else ():
            yield Step("answers", title, _shows(card, number, field))


def _shows(card: DrillCard, number: int, field: str) -> Look:
    """After the n-th message, a field of the topic holds what the card says."""
    tell = card.tells[number]
    assert tell.publishes
    wanted, told = tell.publishes.fields[field], nested(tell.message)
    place = RelayedValue(card.nodes[0], next(iter(tell.message)), tell.publishes, field)

    def asked(turn: int, said: Fields) -> Plain | None:
        return wanted if (turn, said) == (number, told) else None

    return _of_all(show(place, asked))


def _writes(tell: Tell, line: str) -> Look:
    def demand(view: ExperimentView) -> None:
        spoken = [each for each in view.seen.spoken if each.content == nested(tell.message)]
        if not spoken:
            raise NothingShown("not_said", tell.topic)
        texts = view.labelled(PROGRAM).texts
        if not any(line in text for text in texts):
            require_its_time(view.seen, None, 0.0, Awaited("its_line"))
            told = ", ".join(f"{name} {shown(value)}" for name, value in tell.message.items())
            when = AfterTold(told, spoken[0].topic)
            raise NotLogged(PROGRAM, line, most_similar(line, texts), when=when)

    return demand
