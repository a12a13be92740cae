"""Ask a service of another node and wait for the answer."""

from __future__ import annotations

import time
from collections.abc import Iterable
from typing import Any

from ros2_on_pip.discovery import DirectNode
from ros2_on_pip.problem import CommandProblem, did_you_mean

PATIENCE_S = 10.0
"""A node that spins answers in milliseconds."""


class ServiceNotFound(CommandProblem):
    """No node offers the service."""

    def __init__(self, service: str, there: Iterable[str]) -> None:
        super().__init__(
            f"No node offers the service '{service}'.{did_you_mean(service, there)}\n"
            "To see what there is: ros2 service list"
        )


class ServiceSilent(CommandProblem):
    """The node that offers the service stays silent."""

    def __init__(self, service: str, within_s: float) -> None:
        super().__init__(
            f"'{service}' does not answer within {within_s:g} s. Its node runs but does not spin:"
            " look for a loop or a sleep in one of its callbacks."
        )


class CallFailed(CommandProblem):
    """rclpy could not complete the call."""

    def __init__(self, service: str, fault: BaseException) -> None:
        super().__init__(f"Exception while calling service '{service}': {fault}")


AGAIN_S = 2.0
"""A server that has not found our answer's way yet drops the answer; then it is asked again."""


def ask(direct_node: DirectNode, cls: Any, service: str, request: Any, again: bool = True) -> Any:
    """The answer of `service`. Raises ServiceSilent, CallFailed.

    `again` is for requests that may be made twice with the same effect.
    """
    client = direct_node.node.create_client(cls, service)
    try:
        if not direct_node.until(client.service_is_ready, PATIENCE_S):
            raise ServiceSilent(service, PATIENCE_S)
        return _answer(direct_node, client, request, AGAIN_S if again else PATIENCE_S)
    finally:
        direct_node.node.destroy_client(client)


def _answer(direct_node: DirectNode, client: Any, request: Any, each_s: float) -> Any:
    """The answer to the first request, or to one made `each_s` later, and so on."""
    end_s = time.monotonic() + PATIENCE_S
    while True:
        try:
            return answer_of(direct_node, client.srv_name, client.call_async(request), each_s)
        except ServiceSilent:
            if time.monotonic() >= end_s:
                raise ServiceSilent(client.srv_name, PATIENCE_S) from None


def answer_of(direct_node: DirectNode, service: str, future: Any, within_s: float | None) -> Any:
    """What a call returns in the end. Raises ServiceSilent, CallFailed."""
    if not direct_node.until(future.done, within_s):
        raise ServiceSilent(service, within_s or 0.0)
    if fault := future.exception():
        raise CallFailed(service, fault)
    return future.result()
