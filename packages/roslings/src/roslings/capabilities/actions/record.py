"""What was seen of actions: who performs them, and each goal from its request to its result."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from roslings.record import Columns, PartSeen, Record


class ActionEnd(Record):
    """One side of an action: who performs it, or who may give goals to it."""

    kind: Literal["server", "client"]
    node: str = Field(description="Full name of the node")
    action: str
    type: str = Field(description="e.g. `test_msgs/action/Fibonacci`")


class GoalSeen(Record):
    """One goal of an action: what was asked, what came of it, and when."""

    action: str
    type: str
    goal: Any
    part: str = Field(default="", description="The part of the experiment that it belongs to")
    id: list[int] = Field(description="The goal's number of 16 bytes; its feedback carries it")
    sent_ns: int
    answered_ns: int | None = Field(default=None, description="None where nobody answered")
    accepted: bool | None = None
    cancel_sent_ns: int | None = Field(default=None, description="None where it was not cancelled")
    cancel_answered_ns: int | None = None
    cancel_accepted: bool | None = None
    ended_ns: int | None = Field(default=None, description="None where no result came")
    status: str | None = Field(default=None, description="ROS's word, e.g. `succeeded`")
    result: Any = None
    watched_until_ns: int | None = Field(
        default=None, description="How long the robot was watched after it"
    )
    cpu_wait_s: float = Field(
        default=0.0,
        description="From the request to cancel on: how long threads of the node were ready to run"
        " and no processor was free, added up, since a cancel goes from one to the next",
    )

    @property
    def feedback_topic(self) -> str:
        """Where ROS hides the feedback of the action."""
        return f"{self.action}/_action/feedback"


def answer_to(part: str) -> str:
    """The timed stretch in which the goal of a part is to be answered."""
    return f"the answer to the goal {part!r}"


HEARS = "whether the node hears"


class GoalLimits(Record):
    """How long whoever measured waited."""

    answer_within_s: float = Field(default=5.0, description="For the answer to a goal")
    hears_within_s: float = Field(
        default=6.0, description="A node that answers nothing for so long is blocked"
    )
    idle_s: float = Field(
        default=4.0, description="A robot that is told nothing for so long will not get there"
    )
    cancels_within_s: float = Field(default=5.0, description="For the end after a cancel")


def cancelled_after_s(goal: GoalSeen) -> float | None:
    """From the request to cancel to the goal's end; None where there was none of the two."""
    if goal.cancel_sent_ns is None or goal.ended_ns is None:
        return None
    return (goal.ended_ns - goal.cancel_sent_ns) / 1e9


class ActionsSeen(PartSeen):
    """All that was seen of actions in an experiment."""

    NAME = "actions"
    REQUESTS = ("orders",)

    limits: GoalLimits = Field(default_factory=GoalLimits)
    ends: Columns[ActionEnd] = Field(default_factory=list)
    goals: Columns[GoalSeen] = Field(default_factory=list, description="Given by the grader")
    orders: Columns[GoalSeen] = Field(default_factory=list, description="Given to the grader")
