"""Experiments with services: ask a server, many times and from several sides; be a server."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager

from ros2_on_pip.near_names import nearest
from roslings.arena import Process
from roslings.capabilities.services.calling import Caller, Server, ServiceCall
from roslings.capabilities.services.contract import (
    MOST_LATE,
    AnswerContract,
    ServiceContract,
    ServiceWords,
)
from roslings.capabilities.services.graph import read_services
from roslings.capabilities.services.record import CLIENT_ENDS, CallLimits, ServiceEnd, ServicesSeen
from roslings.course import NodeContract, TopicContract
from roslings.evidence import StageMark
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.scene import Scene
from roslings.experiment.timing import accounting, timing
from roslings.seen.matching import nearest_endpoint

ANSWER_WITHIN_S = 5.0
"""No answer for so long is none; a late one is still an answer, and told as late."""

TURNS_WITHIN_S = 2.0
ENDS_WITHIN_S = 2.0
"""For a program that ends by itself, beyond the time that its card gives it."""

STATE_WITHIN_S = 3.0
STATE_MESSAGES = 2
"""The first message after an answer may have been under way before it."""


class Asker:
    """Asks the services of one running node, as clients do."""

    def __init__(self, scene: Scene, process: Process, node: NodeContract) -> None:
        """Looks for the node's services, and waits until they are all there."""
        self._scene, self._process, self._node = scene, process, node
        self._silent = False
        scene.seen.recording(ServicesSeen).limits = CallLimits(answer_within_s=ANSWER_WITHIN_S)
        scene.appears(self._all_there, "all services")

    def ask_each(
        self, service: ServiceContract, answers: Sequence[AnswerContract], state: TopicContract
    ) -> None:
        """Ask once for each of `answers`, and watch what `state` says afterwards."""
        with self._client_of(service) as callers, accounting(self._scene, service.service):
            for number, answer in enumerate(answers):
                for call in self._ask(callers, [answer], service.service, number):
                    self._watch_state(call, state)

    def ask_once(self, service: ServiceContract, answer: AnswerContract) -> None:
        """Ask, to bring the node into a state that the next requests need."""
        with self._client_of(service) as callers:
            self._ask(callers, [answer], "before", 0)

    def ask_in_a_row(
        self,
        service: ServiceContract,
        answers: Sequence[AnswerContract],
        count: int,
        part: str = "row",
    ) -> None:
        """Ask again and again, in turn for each of `answers`; stop when too many were late."""
        self._ask_often(service, answers, count, clients=1, part=part)

    def ask_at_once(
        self, service: ServiceContract, answers: Sequence[AnswerContract], count: int, clients: int
    ) -> None:
        """Several clients ask at the same moment, `count` times; stop when too many were late."""
        self._ask_often(service, answers, count, clients, part="crowd")

    def _ask_often(
        self,
        service: ServiceContract,
        answers: Sequence[AnswerContract],
        count: int,
        clients: int,
        part: str,
    ) -> None:
        late = 0
        with self._client_of(service, clients) as callers, timing(self._scene, part):
            for number in range(count):
                turn = [answers[(number + each) % len(answers)] for each in range(len(callers))]
                calls = self._ask(callers, turn, part, number)
                late += sum(_is_late(call, service) for call in calls)
                if late > MOST_LATE * count * clients:
                    return

    @contextmanager
    def _client_of(self, service: ServiceContract, count: int = 1) -> Iterator[list[Caller]]:
        """Clients that are matched with the server; none where there is no server to ask."""
        end = self._server_of(service)
        with ExitStack() as stack:
            callers = [
                stack.enter_context(Caller(self._scene.probe, end.service, end.type, number))
                for number in range(count)
                if end and not self._silent
            ]
            matched = self._scene.until(
                lambda: all(caller.ready for caller in callers), FIRST_MESSAGE_WITHIN_S
            )
            yield callers if matched else []

    def _ask(
        self, callers: Sequence[Caller], turn: Sequence[AnswerContract], part: str, number: int
    ) -> list[ServiceCall]:
        """One request from each caller, and the answers. None after a server fell silent."""
        if self._silent:
            return []
        calls = [c.send(dict(a.request)) for c, a in zip(callers, turn, strict=False)]
        for call in calls:
            call.seen.part, call.seen.number = part, number
            self._scene.seen.recording(ServicesSeen).calls.append(call.seen)
        for call in calls:
            if not call.wait(ANSWER_WITHIN_S, lambda: self._process.alive):
                self._fell_silent()
                break
        return calls

    def _fell_silent(self) -> None:
        """No answer: does the node still run its callbacks, and whom does it wait for?"""
        self._silent = True
        near = nearest(self._node.node, self._scene.seen.graph.nodes)
        if near is None or not self._process.alive:
            return
        if not self._scene.probe.turned(near.found, TURNS_WITHIN_S) and self._process.alive:
            self._scene.seen.stuck.append(near.found)
        self._look()

    def _watch_state(self, call: ServiceCall, state: TopicContract) -> None:
        """Let the state topic speak after an answer."""
        if not call.answered:
            return
        probe, seen = self._scene.probe, self._scene.seen
        publisher = nearest_endpoint(seen.graph, "publisher", state.topic, state.type)
        if publisher:
            topic, before = publisher.topic, probe.count(publisher.topic)
            self._scene.until(lambda: probe.count(topic) >= before + STATE_MESSAGES, STATE_WITHIN_S)
        call.seen.watched_until_ns = time.monotonic_ns()

    def _all_there(self) -> bool:
        self._look()
        servers = [end for end in self._scene.seen.part(ServicesSeen).ends if end.kind == "server"]
        return len(servers) >= len(self._node.of(ServiceWords).serves)

    def _look(self) -> None:
        """Read who serves what; the fullest sight is kept, as of the graph."""
        seen = self._scene.seen
        ends = read_services(self._scene.probe.node, seen.graph.nodes)
        if len(ends) >= len(seen.part(ServicesSeen).ends):
            seen.recording(ServicesSeen).ends = ends

    def _server_of(self, service: ServiceContract) -> ServiceEnd | None:
        """The server to ask: the nearest by name among those of the right type."""
        servers = [
            end
            for end in self._scene.seen.part(ServicesSeen).ends
            if end.kind == "server" and end.type == service.type
        ]
        near = nearest(service.service, (end.service for end in servers))
        return next((end for end in servers if near and end.service == near.found), None)


def _is_late(call: ServiceCall, service: ServiceContract) -> bool:
    if call.seen.answered_ns is None or service.within_s is None:
        return False
    return (call.seen.answered_ns - call.seen.sent_ns) / 1e9 > service.within_s


@contextmanager
def answering(
    scene: Scene, service: ServiceContract, response: Mapping[str, object]
) -> Iterator[None]:
    """A server of our own for as long as the block lasts; it always answers the same."""
    with Server(scene.probe, service.service, service.type, lambda request: dict(response)):
        yield


def await_end(scene: Scene, process: Process, node: NodeContract) -> None:
    """Wait for a node that ends by itself; where it does not, look whether it is stuck."""
    scene.seen.stages.append(StageMark(part=CLIENT_ENDS, at_ns=time.monotonic_ns()))
    gives_up_s = node.gives_up.within_s if node.gives_up else 0.0
    with accounting(scene, CLIENT_ENDS):
        scene.until(lambda: _has_clients(scene), TURNS_WITHIN_S)
        scene.until_own(lambda: not process.alive, gives_up_s + ENDS_WITHIN_S)
    if not process.alive:
        return
    near = nearest(node.node, scene.seen.graph.nodes)
    if near and not scene.probe.turned(near.found, TURNS_WITHIN_S) and process.alive:
        scene.seen.stuck.append(near.found)


def _has_clients(scene: Scene) -> bool:
    """Note whom the nodes may call; a name that nobody serves is then told as a slip."""
    ends = read_services(scene.probe.node, scene.seen.graph.nodes)
    scene.seen.recording(ServicesSeen).ends = ends or scene.seen.part(ServicesSeen).ends
    return any(end.kind == "client" for end in ends)
