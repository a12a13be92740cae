"""Ask a service of another node and wait for the answer."""

from __future__ import annotations

import time
from collections.abc import Iterable
from typing import Any

from ros2_on_pip.discovery import Eye
from ros2_on_pip.problem import Problem, did_you_mean

PATIENCE_S = 10.0
"""A node that spins answers in milliseconds."""


class ServiceNotFound(Problem):
    """No node offers the service."""

    def __init__(self, service: str, there: Iterable[str]) -> None:
        super().__init__(
            f"No node offers the service '{service}'.{did_you_mean(service, there)}\n"
            "To see what there is: ros2 service list"
        )


class NoAnswer(Problem):
    """The node that offers the service stays silent."""

    def __init__(self, service: str, within_s: float) -> None:
        super().__init__(
            f"'{service}' does not answer within {within_s:g} s. Its node runs but does not spin:"
            " look for a loop or a sleep in one of its callbacks."
        )


class CallFailed(Problem):
    """rclpy could not complete the call."""

    def __init__(self, service: str, fault: BaseException) -> None:
        super().__init__(f"Exception while calling service '{service}': {fault}")


AGAIN_S = 2.0
"""A server that has not found our answer's way yet drops the answer; then it is asked again."""


def ask(eye: Eye, cls: Any, service: str, request: Any, again: bool = True) -> Any:
    """The answer of `service`. Raises NoAnswer, CallFailed.

    `again` is for requests that may be made twice with the same effect.
    """
    client = eye.node.create_client(cls, service)
    try:
        if not eye.until(client.service_is_ready, PATIENCE_S):
            raise NoAnswer(service, PATIENCE_S)
        return _answer(eye, client, request, AGAIN_S if again else PATIENCE_S)
    finally:
        eye.node.destroy_client(client)


def _answer(eye: Eye, client: Any, request: Any, each_s: float) -> Any:
    """The answer to the first request, or to one made `each_s` later, and so on."""
    end_s = time.monotonic() + PATIENCE_S
    while True:
        try:
            return answer_of(eye, client.srv_name, client.call_async(request), each_s)
        except NoAnswer:
            if time.monotonic() >= end_s:
                raise NoAnswer(client.srv_name, PATIENCE_S) from None


def answer_of(eye: Eye, service: str, future: Any, within_s: float | None) -> Any:
    """What a call returns in the end. Raises NoAnswer, CallFailed."""
    if not eye.until(future.done, within_s):
        raise NoAnswer(service, within_s or 0.0)
    if fault := future.exception():
        raise CallFailed(service, fault)
    return future.result()
