"""`ros2 action send_goal`: send a goal, show what comes back, cancel it on Ctrl-C."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from ros2_on_pip import stopping
from ros2_on_pip.calling import answer_of
from ros2_on_pip.discovery import DirectNode
from ros2_on_pip.interfaces import class_of, full_name
from ros2_on_pip.names import checked_topic
from ros2_on_pip.node_parts import actions
from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.shared_options import values_in
from ros2_on_pip.words import OK
from ros2_on_pip.yaml_in import filled
from ros2_on_pip.yaml_out import as_indented

STATUS = {
    1: "ACCEPTED",
    2: "EXECUTING",
    3: "CANCELING",
    4: "SUCCEEDED",
    5: "CANCELED",
    6: "ABORTED",
}
"""action_msgs/msg/GoalStatus."""

CANCEL_WITHIN_S = 3.0


class OtherActionType(CommandProblem):
    """The action is there, with another type than the one typed."""

    def __init__(self, action: str, typed: str, right: str) -> None:
        super().__init__(
            f"The action '{action}' has the type {right}, not {typed}."
            f" Type: ros2 action send_goal {action} {right}"
        )


class FeedbackLog:
    """Shows feedback; what a quick server tells before its acceptance came is kept till then."""

    def __init__(self) -> None:
        self._early: list[Any] | None = []

    def take(self, message: Any) -> None:
        """Feedback came: show it, or keep it."""
        if self._early is None:
            print(f"Feedback:\n    {as_indented(message.feedback)}")
        else:
            self._early.append(message)

    def begin(self) -> None:
        """The goal is accepted: show what came before."""
        early, self._early = self._early or [], None
        for message in early:
            self.take(message)


def send(options: argparse.Namespace) -> int:
    """Send the goal of `options` and wait for its end."""
    from rclpy.action import ActionClient

    action = checked_topic(options.action_name)
    type_name = full_name(options.action_type, "action")
    cls = class_of(type_name, "action")
    goal = cls.Goal()
    filled(goal, values_in(options, options.goal))
    with DirectNode(speaks=True) as direct_node:
        client = ActionClient(direct_node.node, cls, action)
        try:
            _await(direct_node, client, action, type_name)
            _run(direct_node, client, goal, options.feedback)
        finally:
            client.destroy()
    return OK


def _await(direct_node: DirectNode, client: Any, action: str, type_name: str) -> None:
    print("Waiting for an action server to become available...")
    if direct_node.until(client.server_is_ready, 0.05):
        return
    there = actions(direct_node.settle())
    if action in there and type_name not in there[action]:
        raise OtherActionType(action, type_name, there[action][0])
    others = [name for name in there if name != action]
    if not client.server_is_ready() and (near := did_you_mean(action, others)):
        print(f"No node serves '{action}' yet.{near}", file=sys.stderr)
    direct_node.until(client.server_is_ready)


def _run(direct_node: DirectNode, client: Any, goal: Any, feedback: bool) -> None:
    print(f"Sending goal:\n     {as_indented(goal)}")
    told = FeedbackLog()
    asked = client.send_goal_async(goal, feedback_callback=told.take if feedback else None)
    accepted = answer_of(direct_node, "send_goal", asked, None)
    if not accepted.accepted:
        print("Goal was rejected.")
        return
    print(f"Goal accepted with ID: {bytes(accepted.goal_id.uuid).hex()}\n")
    told.begin()
    try:
        result = answer_of(direct_node, "get_result", accepted.get_result_async(), None)
    except KeyboardInterrupt:
        _cancel(direct_node, accepted)
        raise
    print(f"Result:\n    {as_indented(result.result)}")
    print(f"Goal finished with status: {STATUS.get(result.status, 'UNKNOWN')}")


def _cancel(direct_node: DirectNode, accepted: Any) -> None:
    stopping.forget()
    print("Canceling goal...")
    answer = answer_of(direct_node, "cancel_goal", accepted.cancel_goal_async(), CANCEL_WITHIN_S)
    print("Goal canceled." if answer.goals_canceling else "Failed to cancel goal")
