"""Ask a node for its parameters, and to set one: by the services that ROS gives each node."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal

from roslings.capabilities.parameters.record import ParameterDeclared, ParameterSet, ParametersSeen
from roslings.capabilities.services.calling import Caller
from roslings.capabilities.services.record import CallSeen
from roslings.probe.probe import Probe


def parameters_of(
    probe: Probe, node: str, within_s: float, while_true: Callable[[], bool] = lambda: True
) -> list[str]:
    """The names of a node's parameters, as the node itself lists them; empty without an answer."""
    service, type_ = f"{node}/list_parameters", "rcl_interfaces/srv/ListParameters"
    answer = _answer_of(probe, service, type_, {}, within_s, while_true)
    return list(answer["result"]["names"]) if answer else []


KINDS: dict[int, Literal["bool", "integer", "double", "string", "other"]] = {
    1: "bool",
    2: "integer",
    3: "double",
    4: "string",
}
"""The numbers of rcl_interfaces/msg/ParameterType."""


def declared_by(
    probe: Probe,
    node: str,
    names: Sequence[str],
    within_s: float,
    while_true: Callable[[], bool] = lambda: True,
) -> list[ParameterDeclared]:
    """Type and value of a node's parameters, as the node itself says; empty without an answer."""
    service, type_ = f"{node}/get_parameters", "rcl_interfaces/srv/GetParameters"
    answer = _answer_of(probe, service, type_, {"names": list(names)}, within_s, while_true)
    values = answer["values"] if answer else []
    return [_declared(node, name, value) for name, value in zip(names, values, strict=False)]


def _answer_of(
    probe: Probe,
    service: str,
    type_: str,
    request: dict[str, Any],
    within_s: float,
    while_true: Callable[[], bool],
) -> dict[str, Any] | None:
    """What a service answers to one request; None where nobody does."""
    with Caller(probe, service, type_) as caller:
        probe.until(lambda: caller.ready or not while_true(), within_s)
        if not caller.ready:
            return None
        call = caller.send(request)
        call.wait(within_s, while_true)
    answer: dict[str, Any] | None = call.seen.response
    return answer


def _declared(node: str, name: str, value: Mapping[str, Any]) -> ParameterDeclared:
    kind = KINDS.get(value["type"], "other")
    return ParameterDeclared(node=node, name=name, type=kind, value=value_of(value))


def value_of(value: Mapping[str, Any]) -> bool | int | float | str | None:
    """What an rcl_interfaces/msg/ParameterValue holds; None where its type is another."""
    kind = KINDS.get(value["type"])
    return None if kind is None else value[f"{kind}_value"]


def message_of(name: str, value: bool | int | float | str) -> Any:
    """An rcl_interfaces/msg/Parameter; its type is the one of the value."""
    from rclpy.parameter import Parameter

    return Parameter(name, value=value).to_parameter_msg()


def set_parameter(
    probe: Probe, node: str, name: str, value: bool | int | float | str, within_s: float
) -> ParameterSet:
    """Ask a node to set one of its parameters; what it answered is written down."""
    said = ParameterSet(node=node, name=name, value=value, asked_ns=time.monotonic_ns())
    probe.seen.recording(ParametersSeen).sets.append(said)
    wanted = message_of(name, value)
    service, type_ = f"{node}/set_parameters", "rcl_interfaces/srv/SetParameters"
    with Caller(probe, service, type_) as caller:
        if probe.until(lambda: caller.ready, within_s):
            call = caller.send({"parameters": [wanted]})
            call.wait(within_s)
            _write_answer(said, call.seen)
    return said


def _write_answer(said: ParameterSet, call: CallSeen) -> None:
    if call.response and call.response["results"]:
        said.answered_ns = call.answered_ns
        said.accepted = bool(call.response["results"][0]["successful"])
        said.reason = str(call.response["results"][0]["reason"])
