"""What a card says about managed nodes, and its rows in task.md."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Literal

from roslings.capability import Row, Words
from roslings.course.contract import Contract, Expected, NodeWords, Stimulus

Transition = Literal["configure", "activate", "deactivate", "cleanup", "shutdown"]
State = Literal["unconfigured", "inactive", "active", "finalized"]


class StepContract(Contract):
    """One transition that is asked for, and the state that it leads to."""

    transition: Annotated[Transition, Stimulus]
    state: Annotated[State, Expected]


class LifecycleWords(NodeWords):
    """What a card may say of a node."""

    lifecycle: tuple[StepContract, ...] = ()


def rows(node: LifecycleWords) -> Iterable[Row]:
    """Each transition, in its order, and where it leads."""
    for step in node.lifecycle:
        yield f"asked to {step.transition}", f"its state is then `{step.state}`"


WORDS = Words(node=LifecycleWords, interface=rows)
