"""Ask a service of another node and wait for the answer."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from roslings.ros2.eye import Eye
from roslings.ros2.problem import Problem, did_you_mean

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


def ask(eye: Eye, cls: Any, service: str, request: Any, within_s: float = PATIENCE_S) -> Any:
    """The answer of `service`. Raises NoAnswer, CallFailed."""
    client = eye.node.create_client(cls, service)
    try:
        if not eye.until(client.service_is_ready, within_s):
            raise NoAnswer(service, within_s)
        return answer_of(eye, service, client.call_async(request), within_s)
    finally:
        eye.node.destroy_client(client)


def answer_of(eye: Eye, service: str, future: Any, within_s: float | None) -> Any:
    """What a call returns in the end. Raises NoAnswer, CallFailed."""
    if not eye.until(future.done, within_s):
        raise NoAnswer(service, within_s or 0.0)
    if fault := future.exception():
        raise CallFailed(service, fault)
    return future.result()
