"""What a card says about actions, and its rows in task.md."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

from pydantic import Field

from roslings.capability import Row, Words
from roslings.course.contract import (
    Contract,
    Expected,
    NodeWords,
    Promise,
    Prose,
    RateContract,
)
from roslings.course.kinds import Kind

RESTLESS = 5.0
"""Feedback that is so many times too frequent comes from a loop without a pause."""


class ActionContract(Contract):
    """One action that a node performs, or that it gives goals to."""

    action: Annotated[str, Expected] = Field(pattern=r"^/[A-Za-z_][A-Za-z0-9_/]*$")
    type: Annotated[str, Expected] = Field(pattern=r"^[a-z][a-z0-9_]*/action/[A-Z][A-Za-z0-9]*$")
    goal: Annotated[dict[str, float], Prose] = Field(
        default_factory=dict, description="One goal, as an example"
    )
    feedback: RateContract | None = None
    cancels_within_s: Annotated[float | None, Kind.MOST] = Field(
        default=None, gt=0, description="From the request to cancel until all stands still"
    )
    rules: Annotated[dict[str, str], Promise] = Field(
        default_factory=dict, description="What happens when: two columns of the task's table"
    )


class ActionWords(NodeWords):
    """What a card may say of a node."""

    performs: tuple[ActionContract, ...] = ()
    orders: tuple[ActionContract, ...] = ()


def rows(node: ActionWords) -> Iterable[Row]:
    """Each action with its type, its feedback, its rules and its time."""
    verbs = {"performs": node.performs, "sends goals to": node.orders}
    for verb, action in ((verb, action) for verb, each in verbs.items() for action in each):
        yield verb, f"`{action.action}`"
        yield from _rows_of(action)


def _rows_of(action: ActionContract) -> Iterable[Row]:
    yield "action type", f"`{action.type}`"
    if rate := action.feedback:
        span = f"{rate.low_hz:.4g} Hz to {rate.high_hz:.4g} Hz is right"
        yield "feedback", f"{rate.hz:g} Hz while it works; {span}"
    yield from action.rules.items()
    if action.cancels_within_s:
        yield "time to cancel", f"{action.cancels_within_s:g} s at most, until all stands still"


WORDS = Words(node=ActionWords, interface=rows)
