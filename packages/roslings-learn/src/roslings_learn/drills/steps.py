"""What is demanded of a drill's program, in the order in which it is mended: all from the card.

The demands are those of the labs. The first one that is not met is the verdict.
"""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from roslings.capabilities.parameters.demands import declare_its_parameters
from roslings.capabilities.services.demands import (
    answer_each,
    ask,
    serve,
    serve_their_types,
    tell_the_answer,
)
from roslings.capabilities.services.record import ServicesSeen
from roslings.capabilities.topics.act import nested
from roslings.capabilities.topics.demands import count_up, have_rate, say_its_text
from roslings.capabilities.topics.faults.messages import NoMessages
from roslings.course import NodeContract, TopicContract
from roslings.evidence import Spoken
from roslings.judge import (
    ExperimentView,
    NothingToJudge,
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
from roslings.judge.faults import DidNotComeUp, NotLogged
from roslings.judge.views import Demand, ProcessView
from roslings.judge.words import describe_end
from roslings.matching import nearest_endpoint
from roslings_learn.drills import faults
from roslings_learn.drills.answers import compare
from roslings_learn.drills.card import PROGRAM, DrillCard, Heard, Tell
from roslings_learn.drills.goals import demands_of
from roslings_learn.drills.same import same

ENDS_WITHIN_S = 2.0
BY_GRAPH = ("runs", "stays", "spins", "name", "topic", "qos")
"""Steps that look at what is there, not at what is said: no clock can bend them."""


@dataclass(frozen=True)
class Step:
    """One demand: its short name, the sentence for it, and what looks at the evidence."""

    name: str
    title: str
    demand: Callable[[ExperimentView], None]

    @property
    def by_graph(self) -> bool:
        """Whether it is judged before all that is said."""
        return self.name in BY_GRAPH


def steps_of(card: DrillCard, said: Any = None) -> Iterator[Step]:
    """All that is demanded, in order; `said` is what the student has foretold."""
    yield from _of_processes(card) if card.nodes else ()
    yield from _of_output(card)
    for node in card.nodes:
        yield from _of_topics(node)
    for node in card.nodes:
        yield from _of_what_it_hears(node, card)
        yield from _of_services(node)
    for tell in card.tells:
        yield Step("answers", f"It makes the right thing of {tell.topic}.", _reacts(tell))
    for name, title, demand in demands_of(card):
        yield Step(name, title, demand)
    if card.answer:
        title = "What you foretold is what the run shows."
        yield Step("foretold", title, lambda view: compare(said, card, view))
    yield from _of_ends(card)


def _of_output(card: DrillCard) -> Iterator[Step]:
    for text in card.prints:
        yield Step("prints", f"It prints {text!r}.", _prints(text))
    for text in card.never_prints:
        yield Step("silent", f"It does not print {text!r}.", _never_prints(text))


def _of_processes(card: DrillCard) -> Iterator[Step]:
    first = card.nodes[0]
    if card.exits is None:
        look = _script_comes_up if card.program == "bash" else come_up
        yield Step("runs", "The program starts and makes a node.", _unless_asked(first, look))
        yield Step("stays", "It runs until Ctrl-C.", _unless_asked(first, stay_up))
    else:
        yield Step("runs", "The program does its task without an error.", _no_traceback(card))
    if card.exits is None:
        yield Step("spins", "It runs its callbacks.", _spins)
    for node in card.nodes if card.exits is None else ():
        yield Step("name", f"The node is called {node.node}.",
                   lambda view, node=node: view.node(node).must(be_named))  # type: ignore[misc]  # fmt: skip
    for node in card.nodes:
        yield from _of_endpoints(node)
        if node.parameters:
            yield Step("parameter", "It has the parameters that the card names.",
                       lambda view, node=node: view.must(declare_its_parameters(node)))  # type: ignore[misc]  # fmt: skip


def _script_comes_up(process: ProcessView) -> None:
    """As `come_up`, in words for a script."""
    try:
        come_up(process)
    except DidNotComeUp as fault:
        raise faults.ScriptMakesNoNode(fault.executable, fault.how, log=fault.log) from None


def _unless_asked(
    node: NodeContract, look: Demand[ProcessView]
) -> Callable[[ExperimentView], None]:
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
        yield Step("topic", title, _published(node, topic))
        title = f"Who subscribes to {topic.topic} can hear it (QoS)."
        yield Step("qos", title, _qos_of_publisher(node, topic))
    for topic in node.subscribes:
        title = f"It subscribes to {topic.topic}, type {topic.type}."
        yield Step("topic", title, _subscribed(node, topic))
        title = f"It can hear who publishes on {topic.topic} (QoS)."
        yield Step("qos", title, _qos_of_subscription(node, topic))


def _published(node: NodeContract, topic: TopicContract) -> Callable[[ExperimentView], None]:
    return lambda view: view.publisher(node, topic).must(be_there, carry_its_type, be_the_only_one)


def _subscribed(node: NodeContract, topic: TopicContract) -> Callable[[ExperimentView], None]:
    return lambda view: view.subscription(node, topic).must(be_there, carry_its_type)


def _qos_of_publisher(node: NodeContract, topic: TopicContract) -> Callable[[ExperimentView], None]:
    return lambda view: view.publisher(node, topic).must(match_qos)


def _qos_of_subscription(
    node: NodeContract, topic: TopicContract
) -> Callable[[ExperimentView], None]:
    return lambda view: view.subscription(node, topic).must(match_qos)


def _of_topics(node: NodeContract) -> Iterator[Step]:
    """What the messages of the node say, and how often they come."""
    for topic in node.publishes:
        if topic.rate:
            yield Step("rate", f"{topic.topic} carries {topic.rate.hz:g} messages a second.",
                       lambda view, t=topic: view.topic(t).must(have_rate(t)))  # type: ignore[misc]  # fmt: skip
        if topic.text or topic.fields:
            yield Step("message", f"The messages on {topic.topic} say what the card says.",
                       lambda view, t=topic: _says(view, t))  # type: ignore[misc]  # fmt: skip
        if topic.text and "{n}" in topic.text:
            yield Step("counting", "The number goes up by one from message to message.",
                       lambda view, t=topic: view.topic(t).must(count_up))  # type: ignore[misc]  # fmt: skip
        if topic.text and node.log and not node.subscribes:
            yield Step(
                "logs", "It writes each message that it publishes, once.", _logs(node, topic)
            )


def _says(view: ExperimentView, topic: TopicContract) -> None:
    seen = view.topic(topic)
    if not seen.messages:
        require_steady(view.seen.stall_s)
        raise NoMessages(seen.name, 0, view.seen.watching_s)
    if topic.text:
        seen.must(say_its_text)
    for message in seen.messages:
        for name, wanted in topic.fields.items():
            found = _field(message.content, name)
            if not same(found, wanted):
                raise faults.WrongField(seen.name, name, f"{wanted!r}", f"{found!r}")


def _logs(node: NodeContract, topic: TopicContract) -> Callable[[ExperimentView], None]:
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
    for service in node.serves:
        yield Step("service", f"It serves {service.service}, type {service.type}.",
                   lambda view, s=service: view.must(serve(s), serve_their_types(s)))  # type: ignore[misc]  # fmt: skip
        yield Step("answers", f"{service.service} gives the answers of the card.",
                   lambda view, s=service: view.must(answer_each(node, s)))  # type: ignore[misc]  # fmt: skip
    for service in node.calls:
        yield Step("asks", f"It calls {service.service} with the card's request.",
                   lambda view, s=service: view.must(ask(node, s)))  # type: ignore[misc]  # fmt: skip
        if node.log:
            yield Step("tells", "It writes what the answer says.",
                       lambda view: view.must(tell_the_answer(node)))  # fmt: skip


def _of_ends(card: DrillCard) -> Iterator[Step]:
    if card.exits is not None:
        title = f"It ends by itself, with exit code {card.exits}."
        yield Step("exits", title, lambda view: _require_exit(card, view))
    if card.ends_well:
        node = card.nodes[0]
        yield Step("ends", "Ctrl-C ends it at once.",
                   lambda view: view.process(node).must(end_within(ENDS_WITHIN_S)))  # fmt: skip
        yield Step("clean_exit", "After Ctrl-C it ends without an error.",
                   lambda view: view.process(node).must(exit_cleanly))  # fmt: skip


# --- what the program prints, and how it ends --------------------------------------------------


def _lines(view: ExperimentView) -> list[str]:
    return view.labelled(PROGRAM).texts


def _prints(text: str) -> Callable[[ExperimentView], None]:
    def demand(view: ExperimentView) -> None:
        lines = _lines(view)
        if not any(text in line for line in lines):
            require_steady(view.seen.stall_s)
            near = difflib.get_close_matches(text, lines, n=1, cutoff=0.5) or lines[:1]
            raise faults.NotPrinted(text, near[0] if near else None, log=tuple(lines[-40:]))

    return demand


def _never_prints(text: str) -> Callable[[ExperimentView], None]:
    def demand(view: ExperimentView) -> None:
        for line in _lines(view):
            if text in line:
                raise faults.PrintedAnyway(text, line)

    return demand


def _no_traceback(card: DrillCard) -> Callable[[ExperimentView], None]:
    """Of a program that ends: that it does not, or ends with an error, is told before all else.

    One that waits for an answer runs on since it did not ask: what it did not ask is told.
    """

    def demand(view: ExperimentView) -> None:
        broke = any(line.startswith("Traceback") for line in _lines(view))
        runs_on = not view.seen.processes[PROGRAM].ended_by_itself
        if broke or (runs_on and not card.waits_for_answers):
            _require_exit(card, view)

    return demand


def _require_exit(card: DrillCard, view: ExperimentView) -> None:
    seen = view.seen.processes[PROGRAM]
    if not seen.ended_by_itself:
        require_steady(view.seen.stall_s)
        raise faults.RunsOn(view.seen.watching_s)
    if seen.status != card.exits:
        log = view.labelled(PROGRAM).last_lines()
        raise faults.WrongExitCode(card.exits or 0, describe_end(seen), log=log)


# --- what comes of what it is told -------------------------------------------------------------


def _reacts(tell: Tell) -> Callable[[ExperimentView], None]:
    def demand(view: ExperimentView) -> None:
        spoken = _spoken(tell, view)
        told = f"{spoken.topic} ({', '.join(f'{k}: {v}' for k, v in tell.message.items())})"
        if tell.log is not None:
            _require_line(tell.log, told, view)
        if tell.publishes:
            _require_message(tell.publishes, told, spoken, view)

    return demand


def _spoken(tell: Tell, view: ExperimentView) -> Spoken:
    content = nested(tell.message)
    for each in view.seen.spoken:
        if each.content == content:
            return each
    raise NothingToJudge(f"nothing could be said on {tell.topic}")


def _require_line(wanted: str, told: str, view: ExperimentView) -> None:
    texts = view.labelled(PROGRAM).texts
    if not any(wanted in text for text in texts):
        require_its_time(view.seen, None, 0.0, "its line")
        raise NotLogged(PROGRAM, wanted, most_similar(wanted, texts), when=f"after {told}")


def _require_message(wanted: Heard, told: str, spoken: Spoken, view: ExperimentView) -> None:
    topic = view.topic(TopicContract(topic=wanted.topic, type=wanted.type))
    after = [m for m in topic.messages if m.arrival_ns > spoken.sent_ns]
    hope = f"{wanted.topic} carries {_fields(wanted.fields)}"
    if not after:
        require_steady(view.seen.stall_s)
        raise faults.NoReaction(told, hope)
    found = {name: _field(after[0].content, name) for name in wanted.fields}
    if not all(same(found[name], value) for name, value in wanted.fields.items()):
        raise faults.WrongReaction(told, hope, f"{topic.name} carries {_fields(found)}")


def _fields(fields: dict[str, Any]) -> str:
    return ", ".join(f"{name}: {value}" for name, value in fields.items())


def _field(content: Any, name: str) -> Any:
    """A field of a message, by its name with dots; None where it has none."""
    for part in name.split("."):
        content = content.get(part) if isinstance(content, dict) else None
    return content
