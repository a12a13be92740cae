"""Experiments that set a node's parameters while it runs, one by one and several at once."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from typing import Any

from ros2_on_pip.near_names import nearest
from roslings.arena import Process
from roslings.capabilities.parameters.calling import message_of, value_of
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.parameters.record import (
    ParametersRead,
    ParametersSeen,
    ParameterTrial,
    Values,
)
from roslings.capabilities.services.calling import Caller, ServiceCall
from roslings.course import NodeContract
from roslings.course.contract import Plain
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.scene import Scene

ANSWERS_WITHIN_S = 5.0
SERVICES = {
    "get_parameters": "rcl_interfaces/srv/GetParameters",
    "set_parameters": "rcl_interfaces/srv/SetParameters",
    "set_parameters_atomically": "rcl_interfaces/srv/SetParametersAtomically",
}


class Setter:
    """Sets the parameters of one running node, or of the one nearest to it, and reads them back.

    A node that gave no answer once is not asked again.
    """

    def __init__(
        self,
        scene: Scene,
        process: Process,
        node: str,
        names: Sequence[str],
        callers: Mapping[str, Caller],
    ) -> None:
        self._scene, self._process, self._node, self._names = scene, process, node, names
        self._callers = callers
        self._now: Values | None = self._read()

    def set_one(self, part: str, name: str, value: Plain) -> None:
        """Ask it to set one parameter; `part` says what that is tried for."""
        self._try(part, {name: value}, together=False)

    def set_together(self, part: str, values: Mapping[str, Plain]) -> None:
        """Ask it to set several at once: all of them, or none.

        >>> setter.set_together("both", {"lowest": 0.1, "highest": 0.4})
        """
        self._try(part, values, together=True)

    def _try(self, part: str, values: Mapping[str, Plain], together: bool) -> None:
        if self._now is None:
            return
        tried = ParameterTrial(
            part=part,
            node=self._node,
            asked=dict(values),
            together=together,
            asked_ns=time.monotonic_ns(),
            before=self._now,
        )
        self._scene.seen.recording(ParametersSeen).trials.append(tried)
        service = "set_parameters_atomically" if together else "set_parameters"
        wanted = [message_of(name, value) for name, value in values.items()]
        call = self._ask(service, {"parameters": wanted})
        self._now = None
        if call.seen.response:
            _write_answer(tried, call, together)
            self._now = self._read()
            tried.after = self._now or {}

    def _read(self) -> Values | None:
        """What the parameters are; None where the node does not say."""
        response = self._ask("get_parameters", {"names": list(self._names)}).seen.response
        if not response:
            return None
        return dict(zip(self._names, map(value_of, response["values"]), strict=False))

    def _ask(self, service: str, request: dict[str, Any]) -> ServiceCall:
        call = self._callers[service].send(request)
        call.wait(ANSWERS_WITHIN_S, lambda: self._process.alive)
        return call


def _write_answer(tried: ParameterTrial, call: ServiceCall, together: bool) -> None:
    response = call.seen.response or {}
    result = response["result"] if together else response["results"][0]
    tried.answered_ns = call.seen.answered_ns
    tried.accepted, tried.reason = bool(result["successful"]), str(result["reason"])


@contextmanager
def setting(scene: Scene, process: Process, node: NodeContract) -> Iterator[Setter | None]:
    """Clients of the node's own services; None where it does not offer them.

    >>> with scene.run(LIMITER) as process, setting(scene, process, LIMITER) as setter:
    ...     if setter:
    ...         setter.set_one("live", "max_speed", 0.8)
    """
    near = nearest(node.node, scene.seen.graph.nodes)
    with ExitStack() as stack:
        callers = {
            name: stack.enter_context(Caller(scene.probe, f"{near.found}/{name}", type_))
            for name, type_ in SERVICES.items()
            if near
        }
        names = [parameter.name for parameter in node.of(ParameterWords).parameters]
        ready = scene.until(
            lambda: all(caller.ready for caller in callers.values()), FIRST_MESSAGE_WITHIN_S
        )
        yield Setter(scene, process, near.found, names, callers) if near and ready else None


def read_all(scene: Scene) -> None:
    """Ask each node in the graph for all of its parameters; who gives no answer is left out."""
    nodes = sorted(set(scene.seen.graph.nodes))
    listed = _answers(scene, nodes, "ListParameters", [{}] * len(nodes))
    names = {node: list(answer["result"]["names"]) for node, answer in listed.items()}
    requests = [{"names": each} for each in names.values()]
    for node, answer in _answers(scene, list(names), "GetParameters", requests).items():
        values = dict(zip(names[node], map(value_of, answer["values"]), strict=False))
        scene.seen.recording(ParametersSeen).read.append(ParametersRead(node=node, values=values))


TRIES = 2
"""An answer that has no way back yet is lost without a word: who gave none is asked once more."""
ENDS = {"ListParameters": "list_parameters", "GetParameters": "get_parameters"}


def _answers(
    scene: Scene, nodes: Sequence[str], kind: str, requests: Sequence[dict[str, Any]]
) -> dict[str, dict[str, Any]]:
    """Node to its answer; all are asked before the first answer is waited for."""
    type_ = f"rcl_interfaces/srv/{kind}"
    with ExitStack() as stack:
        callers = {
            node: stack.enter_context(Caller(scene.probe, f"{node}/{ENDS[kind]}", type_))
            for node in nodes
        }
        scene.until(lambda: all(each.ready for each in callers.values()), FIRST_MESSAGE_WITHIN_S)
        wanted = dict(zip(nodes, requests, strict=True))
        found: dict[str, dict[str, Any]] = {}
        for _ in range(TRIES):
            left = [node for node in nodes if callers[node].ready and node not in found]
            found |= _answers_now(scene, {node: callers[node].send(wanted[node]) for node in left})
    return found


def _answers_now(scene: Scene, calls: Mapping[str, ServiceCall]) -> dict[str, dict[str, Any]]:
    for call in calls.values():
        call.wait(ANSWERS_WITHIN_S, scene.arena.all_alive)
    return {node: call.seen.response for node, call in calls.items() if call.seen.response}
