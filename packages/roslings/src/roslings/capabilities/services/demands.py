"""Demands on services: names, answers, the state behind them, and how soon they come."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from ros2_on_pip.near_names import nearest
from ros2_on_pip.rates import NS_PER_S
from roslings.capabilities.services import faults
from roslings.capabilities.services.contract import MOST_LATE, AnswerContract, ServiceContract
from roslings.capabilities.services.reasons import LateByTheMachine, NoCall
from roslings.capabilities.services.record import CLIENT_ENDS, CallSeen, ServiceEnd, ServicesSeen
from roslings.course import GiveUpContract, NodeContract, TopicContract
from roslings.course.contract import Plain
from roslings.course.files import written
from roslings.evidence import ExperimentSeen
from roslings.judge.demands import (
    insist_on_at_most,
    most_similar,
    require_its_time,
    require_steady,
)
from roslings.judge.faults import EndedWithError, NotLogged
from roslings.judge.faults.moments import Awaited, When
from roslings.judge.faults.processes import Does
from roslings.judge.faults.sentences import Text
from roslings.judge.faults.writing import PlaceInCode
from roslings.judge.values import same
from roslings.judge.views import Demand, ExperimentView, ProcessView, TopicView
from roslings.judge.words import end_of, how_it_went
from roslings.seen.matching import nearest_endpoint

ANSWERED = When("answered")

# --- who serves what ---------------------------------------------------------------------------


def serve(service: ServiceContract) -> Demand[ExperimentView]:
    """A node serves it under its very name."""

    def demand(experiment: ExperimentView) -> None:
        end = _server(experiment, service)
        if end is None:
            clients = _ends(experiment, "client")
            raise faults.NoService(
                service.service, any(each.service == service.service for each in clients)
            )
        near = nearest(service.service, [end.service])
        if near and not near.exact:
            raise faults.WrongService(near)

    return demand


def serve_once(service: ServiceContract) -> Demand[ExperimentView]:
    """Only one server has its name: of two, both answer each call."""

    def demand(experiment: ExperimentView) -> None:
        servers = [end for end in _ends(experiment, "server") if end.service == service.service]
        if len(servers) > 1:
            raise faults.ServedTwice(service.service, len(servers))

    return demand


def serve_their_types(*services: ServiceContract) -> Demand[ExperimentView]:
    """Each service has the card's type. Of one that is missing no type was seen."""

    def demand(experiment: ExperimentView) -> None:
        found = [(service, _server(experiment, service)) for service in services]
        for service, end in found:
            if end is not None and end.type != service.type:
                raise faults.WrongServiceType(end.service, service.type, end.type)
        for service, end in found:
            if end is None:
                raise NoCall("no_type", service.service)

    return demand


def _ends(experiment: ExperimentView, kind: str) -> list[ServiceEnd]:
    return [end for end in experiment.seen.part(ServicesSeen).ends if end.kind == kind]


def _server(experiment: ExperimentView, service: ServiceContract) -> ServiceEnd | None:
    """The server that is meant: the very name, else the nearest one, the right type first.

    A name that has nothing in common with it is another service, not a slip.
    """
    servers = _ends(experiment, "server")
    same_type = [end for end in servers if end.type == service.type]
    exact = [end for end in servers if end.service == service.service]
    pool = exact or same_type or servers
    near = nearest(service.service, (end.service for end in pool))
    if near is None or near.how == "other":
        return None
    return next(end for end in pool if end.service == near.found)


# --- answers -----------------------------------------------------------------------------------


def answer_each(node: NodeContract, service: ServiceContract) -> Demand[ExperimentView]:
    """Each request of the conversation gets the card's answer."""

    def demand(experiment: ExperimentView) -> None:
        for call in _conversation(experiment, service):
            answer = service.answers[call.number]
            _require_answer(experiment, node, call, answer)
            _compare(call, answer)

    return demand


def show_each(services: Sequence[ServiceContract], topic: TopicContract) -> Demand[ExperimentView]:
    """After each answer the topic says what the card says."""
    answers = {service.service: service.answers for service in services}

    def demand(experiment: ExperimentView) -> None:
        calls = [
            c
            for c in experiment.seen.part(ServicesSeen).calls
            if c.part in answers and c.answered_ns
        ]
        if not calls:
            raise NoCall("unanswered")
        for call in calls:
            answer = answers[call.part][call.number]
            found = _said_after(experiment, call, topic)
            if not same(found, answer.state, topic.numbers_within):
                shown = None if found is None else f"{found}"
                raise faults.WrongState(
                    topic.topic, f"{answer.state}", shown, call.service, _asked(call)
                )

    return demand


def say_at_first(state: Plain | None) -> Demand[TopicView]:
    """Before anybody asks for anything, each message says this."""

    def demand(topic: TopicView) -> None:
        contents = [m.content for m in topic.messages if isinstance(m.content, dict)]
        for found in (content.get("data") for content in contents):
            if not same(found, state, topic.contract.numbers_within):
                raise faults.WrongState(topic.name, f"{state}", f"{found}")

    return demand


def _conversation(experiment: ExperimentView, service: ServiceContract) -> list[CallSeen]:
    calls = [
        call for call in experiment.seen.part(ServicesSeen).calls if call.part == service.service
    ]
    if not calls:
        raise NoCall("uncalled", service.service)
    return calls


def _require_answer(
    experiment: ExperimentView, node: NodeContract, call: CallSeen, answer: AnswerContract
) -> None:
    """Raises the fault that tells why no answer came."""
    if call.response is not None:
        return
    process = experiment.process(node)
    asked = _case(call, answer)
    waited_s = experiment.seen.part(ServicesSeen).limits.answer_within_s
    if process.seen.ended_by_itself:
        raise faults.EndedInsteadOfAnswering(
            call.service, asked, waited_s, log=process.last_lines()
        )
    if experiment.seen.stuck:
        calls = tuple(sorted({end.service for end in _ends(experiment, "client")}))
        if calls:
            raise faults.Deadlock(call.service, asked, waited_s, calls)
        raise faults.StuckInCallback(call.service, asked, waited_s)
    require_steady(experiment.seen.stall_s)
    require_its_time(experiment.seen, call.part, waited_s, Awaited("answer"))
    raise faults.NoAnswer(call.service, asked, waited_s)


def _compare(call: CallSeen, answer: AnswerContract) -> None:
    for name, wanted in answer.response.items():
        found = call.response.get(name)
        if not same(found, wanted):
            raise faults.WrongAnswer(
                call.service,
                _case(call, answer),
                name,
                _shown(wanted),
                _shown(found),
                case="" if call.request else answer.when,
            )


def _case(call: CallSeen, answer: AnswerContract) -> str:
    """The request; where it has no fields, the card's words for the case."""
    return _asked(call) or answer.when


def _asked(call: CallSeen) -> str:
    """The request as it stands behind the service's name; empty where it has no fields."""
    return ", ".join(f"{name}: {_shown(value)}" for name, value in call.request.items())


def _shown(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else repr(value)


def _said_after(experiment: ExperimentView, call: CallSeen, topic: TopicContract) -> Any:
    """The last value of the topic while it was watched after a call; None where none came."""
    publisher = nearest_endpoint(experiment.seen.graph, "publisher", topic.topic, topic.type)
    heard = experiment.seen.topics.get(publisher.topic) if publisher else None
    if heard is None:
        raise NoCall("nothing_came", topic.topic)
    start_ns, end_ns = call.answered_ns or 0, call.watched_until_ns or 0
    said = [
        message.content["data"]
        for message in heard.messages
        if start_ns < message.arrival_ns <= end_ns
        and isinstance(message.content, dict)
        and "data" in message.content
    ]
    return said[-1] if said else None


def before_the_calls(experiment: ExperimentView, topic: TopicContract) -> TopicView:
    """The topic as it was while nobody asked for anything."""
    view = experiment.topic(topic)
    first_ns = min(
        (call.sent_ns for call in experiment.seen.part(ServicesSeen).calls), default=None
    )
    quiet = [m for m in view.messages if first_ns is None or m.arrival_ns < first_ns]
    return replace(view, heard=view.heard.model_copy(update={"messages": quiet}))


# --- how soon ----------------------------------------------------------------------------------


def answer_in_time(
    node: NodeContract, service: ServiceContract, part: str, who: str, asked: int
) -> Demand[ExperimentView]:
    """Nearly every answer of this part of the experiment comes within the card's time."""
    limit_s = written(service.within_s, service.service)

    def demand(experiment: ExperimentView) -> None:
        calls = [call for call in experiment.seen.part(ServicesSeen).calls if call.part == part]
        if not calls:
            raise NoCall("uncalled", service.service)
        for call in calls:
            _require_answer(experiment, node, call, _answer_to(call, service))
            _compare(call, _answer_to(call, service))
        took_s = sorted(_took_s(call) for call in calls)
        late = [each for each in took_s if each > limit_s]
        if len(late) > MOST_LATE * asked:
            _require_worse_than_the_machine(experiment, took_s, limit_s)
            excess_s = sum(each - limit_s for each in late)
            require_its_time(experiment.seen, part, excess_s, Awaited("answers"))
            name = calls[0].service
            raise faults.LateAnswers(name, who, limit_s, len(late), len(calls), took_s[-1])

    return demand


def _answer_to(call: CallSeen, service: ServiceContract) -> AnswerContract:
    return next(answer for answer in service.answers if answer.request == call.request)


def _took_s(call: CallSeen) -> float:
    return ((call.answered_ns or call.sent_ns) - call.sent_ns) / NS_PER_S


def _require_worse_than_the_machine(
    experiment: ExperimentView, took_s: Sequence[float], limit_s: float
) -> None:
    """Single late answers may be this computer's doing. Raises Inconclusive.

    Where half of them are late, no pause of the computer explains that. Where fewer are, they must
    be late by more than the longest time for which the observer itself was not run.
    """
    stall_s = experiment.seen.stall_s
    require_steady(stall_s)
    too_long_s = statistics.median(each for each in took_s if each > limit_s) - limit_s
    if statistics.median(took_s) <= limit_s and too_long_s < stall_s:
        raise LateByTheMachine(too_long_s, stall_s)


# --- clients -----------------------------------------------------------------------------------


def ask(node: NodeContract, service: ServiceContract) -> Demand[ExperimentView]:
    """The client sends the card's request to the server."""
    wanted = service.answers[0].request

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        served = experiment.seen.part(ServicesSeen).served
        if not served:
            require_no_crash(process, "calls", service.service)
            near = nearest(service.service, (e.service for e in _ends(experiment, "client")))
            if near and not near.exact:
                raise faults.AsksElsewhere(near)
            _require_its_type(experiment, service)
            raise faults.DidNotAsk(
                node.executable,
                service.service,
                how_it_went(process.seen),
                log=process.last_lines(6),
            )
        found = served[0].request
        if not _are_same(found, wanted):
            shown = (", ".join(f"{n}: {_shown(v)}" for n, v in d.items()) for d in (wanted, found))
            raise faults.AskedOtherwise(node.executable, *shown)
        if len(served) > 1:
            raise faults.AskedAgain(node.executable, service.service, len(served))

    return demand


def _are_same(found: Mapping[str, Any], wanted: Mapping[str, Any]) -> bool:
    return found.keys() == wanted.keys() and all(same(found[n], wanted[n]) for n in wanted)


def _require_its_type(experiment: ExperimentView, service: ServiceContract) -> None:
    """Raises WrongServiceType where the client has another type than the server."""
    clients = [end for end in _ends(experiment, "client") if end.service == service.service]
    if clients and all(end.type != service.type for end in clients):
        raise faults.WrongServiceType(
            service.service, service.type, clients[0].type, call="create_client"
        )


def require_no_crash(process: ProcessView, does: Does, what: str = "", when: Text = "") -> None:
    """Raises EndedWithError where it ended with a traceback, and had not done what it has to."""
    seen = process.seen
    if seen.ended_by_itself and any(text.startswith("Traceback") for text in process.texts):
        raise EndedWithError(
            seen.executable, does, end_of(seen), what, when, log=process.last_lines()
        )


def tell_the_answer(node: NodeContract) -> Demand[ExperimentView]:
    """The client writes the card's line with the message of the answer."""
    template = written(node.log, node.node)

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        served = experiment.seen.part(ServicesSeen).served
        if experiment.seen.stuck or not served:
            raise NoCall("waits")
        message = str(served[0].response["message"])
        line = template.format(text=message)
        if not any(line in text for text in process.texts):
            near = most_similar(line, process.texts)
            when, place = When("answer_is", message), PlaceInCode("answer")
            raise NotLogged(node.executable, line, near, when=when, place=place)
        insist_on_at_most(process, [line], len(served))

    return demand


def _answered(seen: ExperimentSeen) -> bool:
    """A request of the client came to the grader's server, which answers at once."""
    return bool(seen.part(ServicesSeen).served)


def end_by_itself(
    node: NodeContract,
    exit_code: int | None = 0,
    when: Text = ANSWERED,
    answered: Callable[[ExperimentSeen], bool] = _answered,
) -> Demand[ExperimentView]:
    """The client ends when it has its answer, with this exit code; None: with any.

    `answered` tells whether it was given one.
    """

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        if not process.seen.ended_by_itself:
            require_steady(experiment.seen.stall_s)
            require_its_time(experiment.seen, CLIENT_ENDS, None, Awaited("client_end"))
            if experiment.seen.stuck:
                told = answered(experiment.seen)
                raise faults.ClientDeadlock(node.executable, process.ran_s, told, when=when)
            raise faults.ClientStays(node.executable, process.ran_s, when=when)
        if exit_code is not None:
            require_code(process, exit_code, when)

    return demand


def give_up(node: NodeContract, wait: str = "wait_for_service") -> Demand[ExperimentView]:
    """Without a server the client ends in time, says why, and its exit code says so, too.

    `wait` is the method of the client that waits for a server.
    """
    contract: GiveUpContract = written(node.gives_up, node.node)

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        took_s = _ended_after_s(experiment, process)
        late_s = (process.ran_s if took_s is None else took_s) - contract.within_s
        if took_s is None or late_s > 0:
            require_steady(experiment.seen.stall_s)
            require_its_time(experiment.seen, CLIENT_ENDS, late_s, Awaited("client_end"))
            kind = faults.NeverGivesUp if took_s is None else faults.GivesUpLate
            raise kind(node.executable, took_s or process.ran_s, contract.within_s, wait)
        if not any(contract.log in text for text in process.texts):
            require_no_crash(process, "writes", contract.log, When("server_is_missing"))
            near = most_similar(contract.log, process.texts)
            when, place = When("no_server"), PlaceInCode("no_server")
            raise NotLogged(node.executable, contract.log, near, when=when, place=place)
        require_code(process, contract.exit_code, When("no_server"))

    return demand


def _ended_after_s(experiment: ExperimentView, process: ProcessView) -> float | None:
    """From when its node was there until it ended by itself; None where it did not."""
    if not process.seen.ended_by_itself or process.seen.ended_ns is None:
        return None
    marks = [mark.at_ns for mark in experiment.seen.stages if mark.part == CLIENT_ENDS]
    return (process.seen.ended_ns - marks[-1]) / NS_PER_S if marks else 0.0


def require_code(process: ProcessView, wanted: int, when: Text) -> None:
    """Raises WrongExitCode."""
    seen = process.seen
    if seen.status != wanted:
        raise faults.WrongExitCode(
            seen.executable, when, wanted, end_of(seen), log=process.last_lines(6)
        )
