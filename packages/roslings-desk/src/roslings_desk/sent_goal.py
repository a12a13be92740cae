"""A goal that a page sends: from its sending to its end, with what the server tells meanwhile."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable
from typing import Any

from ros2_on_pip.goal import STATUS
from ros2_on_pip.problem import CommandProblem, did_you_mean
from roslings_desk.asking import answer_of, in_time, is_true
from roslings_desk.hub import Hub

CANCELED = "it was cancelled"
ENDS = {"SUCCEEDED": "it succeeded", "CANCELED": CANCELED, "ABORTED": "the server gave it up"}
"""How a goal ends, by its name in action_msgs/msg/GoalStatus, in plain words."""


class NoActionServer(CommandProblem):
    """No node serves the action."""

    def __init__(self, action: str, there: Iterable[str]) -> None:
        super().__init__(
            f"No node serves the action '{action}'.{did_you_mean(action, there)}\n"
            "To see what there is: ros2 action list"
        )


class Rejected(CommandProblem):
    """The server does not take the goal."""

    def __init__(self, action: str) -> None:
        super().__init__(f"The server of '{action}' rejected this goal. It did not start.")


class NotCanceled(CommandProblem):
    """The server goes on."""

    def __init__(self, action: str) -> None:
        super().__init__(f"The server of '{action}' does not cancel this goal. It goes on.")


class SentGoal:
    """One goal, and the client that sends it. `cancel` may be called while `follow` runs."""

    def __init__(self, hub: Hub, action: str, cls: Any) -> None:
        self._hub, self.action, self._cls = hub, action, cls
        self._handle: Any = None
        self.feedback: Any = None
        """The newest; None before the first."""
        self.feedback_count = 0
        self.is_over = False

    @property
    def is_accepted(self) -> bool:
        """Whether the server has taken it."""
        return self._handle is not None

    async def follow(self, goal: Any) -> tuple[str, Any]:
        """Send it: how it ends in plain words, and its result.

        Raises ServiceSilent, CallFailed, Rejected.
        """
        from rclpy.action import ActionClient

        def connect() -> Any:
            return ActionClient(self._hub.desk_node.node, self._cls, self.action)

        client = await asyncio.wrap_future(self._hub.do(connect))
        try:
            await self._send(client, goal)
            found = await answer_of(self._hub, self.action, self._handle.get_result_async)
        finally:
            self.is_over = True
            self._hub.do(client.destroy)
        name = STATUS.get(found.status, "UNKNOWN")
        return f"{ENDS.get(name, 'it ended')} ({name})", found.result

    async def _send(self, client: Any, goal: Any) -> None:
        await in_time(self.action, is_true(client.server_is_ready))
        asked = answer_of(self._hub, self.action, lambda: self._request(client, goal))
        handle = await in_time(self.action, asked)
        if not handle.accepted:
            raise Rejected(self.action)
        self._handle = handle

    def _request(self, client: Any, goal: Any) -> Any:
        return client.send_goal_async(goal, feedback_callback=self._take)

    def _take(self, message: Any) -> None:
        self.feedback = message.feedback
        self.feedback_count += 1

    async def cancel(self) -> None:
        """Ask the server to end it before its end.

        Raises ServiceSilent, CallFailed, NotCanceled.
        """
        asked = answer_of(self._hub, self.action, self._handle.cancel_goal_async)
        answer = await in_time(self.action, asked)
        if not answer.goals_canceling and not self.is_over:
            raise NotCanceled(self.action)

    def let_go(self) -> None:
        """Nobody follows it any more: cancel it, and wait for no answer."""
        if self.is_accepted and not self.is_over:
            self._hub.do(self._handle.cancel_goal_async)
