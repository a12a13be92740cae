"""Whether a node answers: it is asked again and again for its parameters, which every node has."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

from roslings.capabilities.services.calling import Caller, ServiceCall
from roslings.probe.probe import Probe


class RepeatedRequest:
    """One node, and the requests that it was sent."""

    def __init__(self, caller: Caller) -> None:
        self._caller = caller
        self._calls: list[ServiceCall] = []
        self._sent_s = 0.0

    def first_ns(self, again_s: float) -> int | None:
        """When its first answer came; asks once more where the last request is so old."""
        for call in self._calls:
            if call.answered and call.seen.answered_ns:
                return call.seen.answered_ns
        if time.monotonic() - self._sent_s >= again_s:
            self._sent_s = time.monotonic()
            self._calls.append(self._caller.send({}))
        return None


@contextmanager
def repeated_request(probe: Probe, node: str) -> Iterator[RepeatedRequest]:
    """A client of the node's service `list_parameters`."""
    with Caller(probe, f"{node}/list_parameters", "rcl_interfaces/srv/ListParameters") as caller:
        yield RepeatedRequest(caller)
