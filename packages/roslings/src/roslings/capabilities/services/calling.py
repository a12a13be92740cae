"""Call services and answer them, and keep what was said and when."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from contextlib import suppress
from types import TracebackType
from typing import Any

from roslings.capabilities.services.record import CallSeen, ServicesSeen
from roslings.probe.content import message_class, to_plain
from roslings.probe.probe import Probe

LOOK_EVERY_S = 0.05
Answer = Callable[[dict[str, Any]], dict[str, Any]]


class Caller:
    """One client of one service; leaving the `with` block ends it.

    Raises UnknownType where the service's type is not installed.
    """

    def __init__(self, probe: Probe, service: str, type_: str, number: int = 0) -> None:
        self._probe = probe
        self._service, self._type, self._number = service, type_, number
        self._class: Any = message_class(type_)

    def __enter__(self) -> Caller:
        self._client = self._probe.node.create_client(self._class, self._service)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._probe.node.destroy_client(self._client)

    @property
    def ready(self) -> bool:
        """A server is matched with this client."""
        return bool(self._client.service_is_ready())

    def send(self, request: dict[str, Any]) -> ServiceCall:
        """Ask, and do not wait. Raises AttributeError where the type has no such field."""
        return self.send_message(_filled(self._class.Request(), request), request)

    def send_message(self, message: Any, request: dict[str, Any]) -> ServiceCall:
        """The same with a request that is a ROS message already; `request` is for the record."""
        call = ServiceCall(
            CallSeen(
                service=self._service,
                type=self._type,
                request=request,
                sent_ns=time.monotonic_ns(),
                client=self._number,
            )
        )
        future = self._client.call_async(message)
        future.add_done_callback(call.take)
        return call


class ServiceCall:
    """One call that is under way, or answered."""

    def __init__(self, seen: CallSeen) -> None:
        self.seen = seen
        self._answered = threading.Event()

    @property
    def answered(self) -> bool:
        """The answer is there."""
        return self._answered.is_set()

    def take(self, future: Any) -> None:
        """The answer came: note what it says, and when.

        In this order: who has given up waiting may look at this very moment, and must not see an
        answer that says nothing.
        """
        came_ns = time.monotonic_ns()
        with suppress(Exception):  # an answer that cannot be read is none
            self.seen.response = to_plain(future.result())
        self.seen.answered_ns = came_ns
        self._answered.set()

    def wait(self, within_s: float, while_true: Callable[[], bool] = lambda: True) -> bool:
        """Wait for the answer, as long as `while_true()`. Whether it came."""
        deadline_s = time.monotonic() + within_s
        while not self._answered.wait(LOOK_EVERY_S):
            if time.monotonic() > deadline_s or not while_true():
                return self._answered.is_set()
        return True


class Server:
    """A server of the grader's own; leaving the `with` block ends it."""

    def __init__(self, probe: Probe, service: str, type_: str, answer: Answer) -> None:
        """`answer` turns the fields of a request into those of the response."""
        self._probe, self._service, self._type = probe, service, type_
        self._answer = answer
        self._class: Any = message_class(type_)

    def __enter__(self) -> Server:
        self._server = self._probe.node.create_service(self._class, self._service, self._respond)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._probe.node.destroy_service(self._server)

    def _respond(self, request: Any, response: Any) -> Any:
        asked_ns, asked = time.monotonic_ns(), to_plain(request)
        said = self._answer(asked)
        call = CallSeen(
            service=self._service,
            type=self._type,
            request=asked,
            response=said,
            sent_ns=asked_ns,
            answered_ns=time.monotonic_ns(),
        )
        if self._probe.store.keeps("requests", call):
            self._probe.seen.recording(ServicesSeen).served.append(call)
        self._probe.notify()
        return _filled(response, said)


def _filled(message: Any, fields: dict[str, Any]) -> Any:
    for name, value in fields.items():
        getattr(message, name)  # a misspelt field is an error, not a new attribute
        setattr(message, name, value)
    return message
