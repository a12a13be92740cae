"""Give goals to actions and take goals, and keep what was said and when.

Goals are given by the three services behind each action, not by rclpy's ActionClient. That one
loses an answer which comes before the call that asked for it has returned.
"""

from __future__ import annotations

import time
import uuid
from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack
from types import TracebackType
from typing import Any, Literal

from roslings.capabilities.actions.record import ActionEnd, ActionsSeen, GoalSeen
from roslings.capabilities.services.calling import Caller, ServiceCall
from roslings.capabilities.services.record import CallSeen
from roslings.probe.content import message_class, to_plain
from roslings.probe.probe import Probe

STATUS = {1: "accepted", 2: "executing", 3: "canceling", 4: "succeeded", 5: "canceled"} | {
    6: "aborted"
}
"""action_msgs/msg/GoalStatus, in words."""


class GoalGiver:
    """A client of one action; leaving the `with` block ends it.

    Raises UnknownType where the action's type is not installed.
    """

    def __init__(self, probe: Probe, action: str, type_: str) -> None:
        self._probe, self._action, self._type = probe, action, type_
        self._goal: Any = message_class(f"{type_}_SendGoal")
        parts = {
            "send_goal": f"{type_}_SendGoal",
            "get_result": f"{type_}_GetResult",
            "cancel_goal": "action_msgs/srv/CancelGoal",
        }
        self._callers = {
            part: Caller(probe, f"{action}/_action/{part}", each) for part, each in parts.items()
        }

    def __enter__(self) -> GoalGiver:
        self._stack = ExitStack()
        for caller in self._callers.values():
            self._stack.enter_context(caller)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.close()

    @property
    def ready(self) -> bool:
        """A server is matched with all of it."""
        return all(caller.ready for caller in self._callers.values())

    def give(self, goal: dict[str, float], part: str) -> Goal:
        """Give a goal, and do not wait. Raises AttributeError where it has no such field."""
        number = list(uuid.uuid4().bytes)
        seen = GoalSeen(
            action=self._action,
            type=self._type,
            goal=goal,
            part=part,
            id=number,
            sent_ns=time.monotonic_ns(),
        )
        self._probe.seen.recording(ActionsSeen).goals.append(seen)
        request = self._goal.Request()
        request.goal_id.uuid = number
        for name, value in goal.items():
            getattr(request.goal, name)  # a misspelt field is an error, not a new attribute
            setattr(request.goal, name, value)
        call = self._callers["send_goal"].send_message(request, goal)
        return Goal(seen, call, self.ask_result, self.ask_cancel)

    def ask_result(self, seen: GoalSeen) -> ServiceCall:
        """Ask for the goal's result: the answer comes when the goal has ended."""
        request: Any = message_class(f"{self._type}_GetResult").Request()
        request.goal_id.uuid = seen.id
        return self._callers["get_result"].send_message(request, {})

    def ask_cancel(self, seen: GoalSeen) -> ServiceCall:
        """Ask to cancel the goal."""
        request: Any = message_class("action_msgs/srv/CancelGoal").Request()
        request.goal_info.goal_id.uuid = seen.id
        return self._callers["cancel_goal"].send_message(request, {})


Ask = Callable[[GoalSeen], ServiceCall]


class Goal:
    """One goal that is under way, or has ended."""

    def __init__(self, seen: GoalSeen, sent: ServiceCall, ask_result: Ask, ask_cancel: Ask) -> None:
        self.seen = seen
        self._sent, self._ask_result, self._ask_cancel = sent, ask_result, ask_cancel
        self._result: ServiceCall | None = None
        self._cancel: ServiceCall | None = None

    def await_answer(self, within_s: float, while_true: Callable[[], bool]) -> bool:
        """Wait until the goal is accepted or refused; whether it was accepted."""
        if self._sent.wait(within_s, while_true):
            self._note_answer(self._sent.seen)
        if self.seen.accepted:
            self._result = self._ask_result(self.seen)
        return bool(self.seen.accepted)

    def cancel(self) -> None:
        """Ask to cancel it, and do not wait."""
        self.seen.cancel_sent_ns = time.monotonic_ns()
        self._cancel = self._ask_cancel(self.seen)

    @property
    def cancel_refused(self) -> bool:
        """The server has answered the request to cancel, and will not cancel it."""
        self._note_cancel()
        return self.seen.cancel_accepted is False

    @property
    def ended(self) -> bool:
        """Its result is there; what came is noted."""
        self._note_cancel()
        if self._result is None or not self._result.answered:
            return False
        self._note_result(self._result.seen)
        return True

    def _note_cancel(self) -> None:
        if self._cancel is not None and self._cancel.answered:
            call = self._cancel.seen
            self.seen.cancel_answered_ns = call.answered_ns
            self.seen.cancel_accepted = bool((call.response or {}).get("goals_canceling"))

    def _note_answer(self, call: CallSeen) -> None:
        self.seen.answered_ns = call.answered_ns
        if call.response is not None:
            self.seen.accepted = bool(call.response["accepted"])

    def _note_result(self, call: CallSeen) -> None:
        self.seen.ended_ns = call.answered_ns
        if call.response is not None:
            self.seen.status = STATUS.get(call.response["status"], "unknown")
            self.seen.result = call.response["result"]


class GoalTaker:
    """A server of the grader's own; leaving the `with` block ends it.

    What is done with an accepted goal is said from outside: `tell` and `end`.
    """

    def __init__(self, probe: Probe, action: str, type_: str, accepts: bool = True) -> None:
        self._probe, self._action, self._type, self._accepts = probe, action, type_, accepts
        self._class: Any = message_class(type_)
        self._under_way: list[Any] = []

    def __enter__(self) -> GoalTaker:
        from rclpy.action import ActionServer

        self._server = ActionServer(
            self._probe.node,
            self._class,
            self._action,
            self._finish,
            goal_callback=self._judge,
            handle_accepted_callback=self._take,
        )
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._probe.between_waits(self._server.destroy)

    @property
    def has_goal(self) -> bool:
        """A goal was accepted."""
        return bool(self._under_way)

    def tell(self, feedback: dict[str, float]) -> None:
        """Send one feedback to whoever gave the first goal."""
        message = self._class.Feedback()
        for name, value in feedback.items():
            setattr(message, name, value)
        self._under_way[0].publish_feedback(message)

    def end(self, how: Literal["succeed", "abort"], result: dict[str, Any]) -> None:
        """End the first goal."""
        self._how, self._result = how, result
        self._under_way[0].execute()

    def _judge(self, goal: Any) -> Any:
        from rclpy.action import GoalResponse

        now_ns = time.monotonic_ns()
        order = GoalSeen(
            action=self._action,
            type=self._type,
            goal=to_plain(goal),
            id=[],
            sent_ns=now_ns,
            answered_ns=now_ns,
            accepted=self._accepts,
        )
        if self._probe.store.keeps("requests", order):
            self._probe.seen.recording(ActionsSeen).orders.append(order)
        self._probe.notify()
        return GoalResponse.ACCEPT if self._accepts else GoalResponse.REJECT

    def _take(self, handle: Any) -> None:
        self._under_way.append(handle)
        self._probe.notify()

    def _finish(self, handle: Any) -> Any:
        getattr(handle, self._how)()
        result = self._class.Result()
        for name, value in self._result.items():
            setattr(result, name, value)
        return result


def read_actions(probe_node: Any, nodes: Iterable[str]) -> list[ActionEnd]:
    """The actions of the nodes (full names), from both sides."""
    return [end for node in sorted(set(nodes)) for end in _ends_of(probe_node, node)]


def _ends_of(probe_node: Any, node: str) -> Iterable[ActionEnd]:
    from rclpy._rclpy_pybind11 import NodeNameNonExistentError, RCLError
    from rclpy.action import (
        get_action_client_names_and_types_by_node as clients,
    )
    from rclpy.action import (
        get_action_server_names_and_types_by_node as servers,
    )

    space, _, name = node.rpartition("/")
    try:
        performed = servers(probe_node, name, space or "/")
        ordered = clients(probe_node, name, space or "/")
    except (NodeNameNonExistentError, RCLError):  # it has just left the graph
        return
    yield from _own("server", node, performed)
    yield from _own("client", node, ordered)


def _own(
    kind: Literal["server", "client"], node: str, named: Sequence[tuple[str, list[str]]]
) -> Iterable[ActionEnd]:
    for action, types in named:
        yield ActionEnd(kind=kind, node=node, action=action, type=types[0])
