"""A call's record is whole at every moment at which somebody may look."""

from __future__ import annotations

from dataclasses import dataclass, field

from std_srvs.srv import Trigger

from roslings.capabilities.services.calling import ServiceCall
from roslings.capabilities.services.record import CallSeen


@dataclass
class Looking:
    """A future that looks at the record of its call while its answer is read."""

    seen: CallSeen
    found: list[int | None] = field(default_factory=list)

    def result(self) -> Trigger.Response:
        """The answer."""
        self.found.append(self.seen.answered_ns)
        return Trigger.Response(success=True, message="here")


def test_no_call_is_answered_before_its_answer_is_there() -> None:
    """Who gives up waiting at this moment sees a call without an answer, not an empty answer."""
    seen = CallSeen(service="/a", type="std_srvs/srv/Trigger", request={}, sent_ns=1)
    call, future = ServiceCall(seen), Looking(seen)
    call.take(future)
    assert future.found == [None]
    assert (call.answered, seen.answered_ns is not None) == (True, True)
    assert seen.response == {"success": True, "message": "here"}
